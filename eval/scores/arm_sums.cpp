#include "eval/scores/arm_sums.h"

#include <algorithm>
#include <numeric>

#include "eval/scores/contribution.h"

namespace relock {

std::string_view to_string(CostScore score) {
  constexpr std::array<std::string_view, kCostScores> names{"recognition", "locked share", "availability",
                                                            "losses per minute", "error px"};
  return names[static_cast<std::size_t>(score)];
}

void ArmSums::add(const Recording& recording, const Evaluation& evaluation, const std::vector<bool>& counts) {
  for (RatioSeries& series : series_) {
    series.part.resize(std::max(series.part.size(), recording.frames()));
    series.whole.resize(std::max(series.whole.size(), recording.frames()));
  }
  const auto add_to = [&](CostScore score, std::size_t frame, double part, double whole) {
    RatioSeries& series = series_[static_cast<std::size_t>(score)];
    series.part[frame] += part;
    series.whole[frame] += whole;
  };
  for (std::size_t t = 0; t < recording.targets.size(); ++t) {
    if (!counts[t]) continue;
    const auto frames = contributions(recording, evaluation, t);
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      const Contribution& c = frames[frame];
      add_to(CostScore::recognition, frame, static_cast<double>(c.hits), static_cast<double>(c.could_hit));
      add_to(CostScore::locked_share, frame, seconds(c.locked), seconds(c.visible));
      add_to(CostScore::availability, frame, seconds(c.fresh), seconds(c.visible));
      add_to(CostScore::losses_per_minute, frame, 0, seconds(c.locked) / 60);
    }
    for (const Loss& loss : evaluation.targets[t].losses)
      add_to(CostScore::losses_per_minute, static_cast<std::size_t>(loss.last_good), 1, 0);
  }
}

std::optional<double> value_of(std::span<const RatioSeries> sequences) {
  double part = 0, whole = 0;
  for (const RatioSeries& series : sequences) {
    part = std::accumulate(series.part.begin(), series.part.end(), part);
    whole = std::accumulate(series.whole.begin(), series.whole.end(), whole);
  }
  if (whole <= 0) return {};
  return part / whole;
}

}  // namespace relock
