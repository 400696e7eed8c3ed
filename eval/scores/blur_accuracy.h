#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "eval/scores/localization.h"

namespace relock {

/// How well a method tells the motion during the exposure, over Hits (metrics.md section 6). Empty values: there is
/// nothing to tell from.
struct BlurAccuracy {
  std::size_t blurred = 0;        ///< Hits on a target whose true blur is at least kBlurred of its size D
  std::size_t told = 0;           ///< of these: with an estimate
  std::size_t sharp = 0;          ///< Hits on a target whose true blur is at most kSharp of D
  std::size_t sharp_blurred = 0;  ///< of these: with an estimate that is longer than kBlurred of D

  // Over the estimates of blurred targets: angle to the true axis, 0 to 90; |estimate - truth|, of the true length.
  std::optional<double> direction_median_deg, direction_p95_deg;
  std::optional<double> length_median_percent, length_p95_percent;

  /// Whether the method said anything of blur, right or wrong.
  bool any() const { return told + sharp_blurred > 0; }
};
constexpr double kBlurred = 0.1, kSharp = 0.05;

BlurAccuracy blur_accuracy(std::span<const Fix> fixes);

}  // namespace relock
