#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/recording.h"
#include "core/sighting.h"

// What a recording is, before any run: its times, its labels and its blur in numbers. Definitions are those of
// docs/metrics.md, sections 1 and 2.

namespace relock {

/// Median, 95th percentile and extremes of some values, and the frame of the largest.
struct Spread {
  double least = 0, median = 0, p95 = 0, most = 0;
  FrameIndex most_at = 0;
};

/// Bins of a histogram of intervals, in slots, both ends included; the last one has no upper end.
struct SlotBin {
  std::int64_t from = 1, to = 1;
};
constexpr std::array<SlotBin, 8> kSlotBins{
    {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 8}, {9, 16}, {17, 32}, {33, INT64_MAX}}};

/// Deviations of the intervals of one slot from T.
struct Jitter {
  std::size_t intervals = 0;
  double deviation_ms = 0;    ///< standard deviation, about their mean
  double largest_ms = 0;      ///< largest deviation from T, with its sign
  FrameIndex largest_at = 0;  ///< frame at the interval's end
};

struct IntervalInspection {
  std::vector<std::int64_t> slots;  ///< of each interval, frames - 1 of them
  std::array<std::size_t, kSlotBins.size()> histogram{};
  std::size_t gaps = 0;                            ///< intervals of two slots or more, pauses too
  std::optional<FrameIndex> longest_gap_before{};  ///< frame at the end of the longest gap
  std::vector<FrameIndex> pauses;                  ///< frames at the end of intervals over kPause
  std::optional<double> missing_share{};           ///< of all slots, pauses left out; nothing: no interval
  std::optional<Jitter> jitter{};                  ///< nothing: no interval of one slot
};

struct TargetInspection {
  std::size_t visible = 0, absent = 0, unlabelled = 0;  ///< frames
  std::optional<FrameIndex> first_startable{};
  std::optional<Spread> size_px{};  ///< D, of visible frames
  std::optional<Spread> step_d{};   ///< way of the centre from a frame to the next, in D of the former;
                                    ///< of neighbours that are both visible, no pause between
  std::size_t departures = 0, returns = 0;  ///< changes between visible and absent, unlabelled frames aside
  std::optional<Spread> label_sigma_px{};   ///< of visible frames
  std::optional<Duration>
      longest_unlabelled{};              ///< longest time between labelled frames with an unlabelled one
  std::optional<Spread> true_blur_px{};  ///< length, where the labels state it
  Duration seen_for{};                   ///< from the first startable frame to the last labelled one
};

struct Inspection {
  IntervalInspection intervals;
  std::vector<TargetInspection> targets;
};

/// Of times and labels; no pictures are needed. The recording has at least one frame.
Inspection inspect(const Recording& recording);

/// Blur estimates of one target, or of the whole picture, over a recording.
struct BlurSummary {
  std::size_t measured = 0, below = 0, declined = 0;  ///< frames: a length, length 0, no answer
  std::optional<Spread> length_px{};  ///< over measured and below (as 0); nothing when most were declined
  std::optional<Spread> length_d{};   ///< in the target's D; nothing for the whole picture
};
/// The answer for a frame that was asked about, and the target's size on it (nothing: the whole picture).
struct BlurOfFrame {
  FrameIndex frame = 0;
  std::optional<BlurEstimate> blur{};
  std::optional<double> size_px{};
};
BlurSummary summarise(std::span<const BlurOfFrame> frames);

}  // namespace relock
