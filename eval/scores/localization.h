#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "eval/judgement/evaluation.h"

namespace relock {

/// A Hit and how far off it was.
struct Fix {
  std::size_t frame = 0;
  std::size_t target = 0;
  Vec2 error_px;                          ///< reported - true
  double size_px = 0;                     ///< D
  std::optional<BlurVector> blur;         ///< true blur there, px
  double sigma_px = 0;                    ///< accuracy of the label there
  std::optional<BlurEstimate> told_blur;  ///< what the method says of it
};

/// All Hits on one target, in order; not those on frames whose label stems from the method itself.
std::vector<Fix> fixes(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
                       std::size_t target);

/// How exactly a method knows where the target is, over Hits. Empty values: no Hit (or no blur) to tell from.
struct Localization {
  std::size_t hits = 0;
  std::optional<double> mean_px, rms_px, median_px, p95_px;
  std::optional<double> mean_percent, rms_percent, median_percent, p95_percent;  ///< of D
  std::optional<Vec2> bias_px;           ///< mean of (reported - true)
  std::optional<double> spread_px;       ///< RMS distance from that mean
  std::optional<double> along_blur_px;   ///< RMS error along the blur, where truth has one
  std::optional<double> across_blur_px;  ///< RMS error across it
  std::optional<double> label_sigma_px;  ///< RMS accuracy of the labels behind these Hits; empty: exact
  /// Share of visible frames with e <= .02, .05, .1, .25 D; whatever is not a Hit counts as infinite.
  std::array<std::optional<double>, 4> within;
};
constexpr std::array<double, 4> kWithinD{0.02, 0.05, 0.1, 0.25};

/// `visible_frames`: recognition's denominator, for `within`.
Localization localize(std::span<const Fix> fixes, std::size_t visible_frames);

/// Percentile by linear interpolation between order statistics, `share` in [0, 1]; `values` is not empty.
double percentile(std::vector<double> values, double share);

}  // namespace relock
