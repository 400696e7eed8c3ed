#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/scores/pool.h"
#include "eval/scores/scores.h"
#include "eval/statistics/interval.h"

namespace relock {

/// A score that is a share of a whole: what frames add to it is known, and with that its interval.
struct ShareScore {
  std::string_view name;  ///< as in scores.json
  std::optional<double> Scores::*value;
  double (*part)(const Contribution&);
  double (*whole)(const Contribution&);
};
constexpr std::size_t kShareScores = 6;
/// recognition, precision, availability, availability_of_ceiling, locked_share, locked_share_of_ceiling.
const std::array<ShareScore, kShareScores>& share_scores();

/// How a method's score stands to the best of its table, yardsticks apart, by their paired difference.
enum class Standing : std::uint8_t {
  none,  ///< a yardstick, or no score
  best,
  tied,  ///< as good: the same, or the interval of the difference holds zero
  worse,
  untold,  ///< the data are too few to say
};
std::string_view to_string(Standing standing);

/// Of a time that was taken for each frame, ms.
struct Spread {
  double median_ms = 0, p95_ms = 0, max_ms = 0;
};
/// What a method cost (metrics.md section 6).
struct Cost {
  std::size_t frames = 0;  ///< that it was asked about
  Spread wall, cpu;
  std::int64_t peak_bytes = 0;
};
/// Nothing where no costs were asked for.
std::optional<Cost> cost_of(const std::vector<FrameCost>& costs);

/// A method's scores and how sure they are. Intervals are of 95 %; empty where they cannot be told.
struct JudgedMethod {
  Scores scores;
  Localization common;  ///< over the Hits common to all methods
  std::array<std::optional<Interval>, kShareScores> shares;
  std::array<Standing, kShareScores> standings{};
  std::optional<Interval> losses_per_minute;  ///< exact, of Poisson's distribution
  std::optional<Interval> median_px;
  std::optional<Cost> cost;
};

/// Of each method of the table.
std::vector<JudgedMethod> judged(const ScoreTable& table);

}  // namespace relock
