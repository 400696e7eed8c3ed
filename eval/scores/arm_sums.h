#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "eval/judgement/evaluation.h"
#include "eval/statistics/ratio.h"

namespace relock {

/// What gaps cost, and what a combination gains, is told in these scores, of all targets pooled.
enum class CostScore : std::uint8_t {
  recognition,
  locked_share,
  availability,
  losses_per_minute,  ///< of locked time
  error_px,           ///< median position error over Hits of both arms on the same frame
};
constexpr std::size_t kCostScores = 5;
constexpr std::size_t kRatioScores = 4;  ///< all but the error are a sum over a sum
/// As metrics.md calls it: "locked share".
std::string_view to_string(CostScore score);

/// Of one arm on one sequence, its seeds added up: for each recorded frame what it adds to every score.
class ArmSums {
 public:
  const RatioSeries& operator[](CostScore score) const { return series_[static_cast<std::size_t>(score)]; }

  /// Adds a run, of the targets that `counts` holds true for.
  void add(const Recording& recording, const Evaluation& evaluation, const std::vector<bool>& counts);

 private:
  std::array<RatioSeries, kRatioScores> series_;
};

/// Σ part / Σ whole over all sequences; empty where the whole is nothing.
std::optional<double> value_of(std::span<const RatioSeries> sequences);

}  // namespace relock
