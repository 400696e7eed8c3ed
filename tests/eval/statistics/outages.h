#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "eval/statistics/ratio.h"

namespace relock {

/// A method that fails for whole stretches of frames, as methods do.
struct Outages {
  double rate = 0.2;               ///< share of the frames that lie in an outage
  int shortest = 5, longest = 30;  ///< frames; equally likely. longest 0: geometric with mean `shortest`
  double flicker = 0;              ///< share of the other frames that fail on their own

  double mean_length() const { return longest == 0 ? shortest : (shortest + longest) / 2.0; }
  double truth() const { return (1 - rate) * (1 - flicker); }
};

inline int geometric(Random& random, double mean) {
  return 1 + static_cast<int>(std::floor(std::log(1 - random.uniform()) / std::log(1 - 1 / mean)));
}

/// 1 for every frame that succeeds, 0 for one that fails; begun long before its first frame.
inline std::vector<double> simulate_outages(Random& random, std::size_t frames, const Outages& outages) {
  std::vector<double> good;
  const double mean_between = outages.mean_length() * (1 - outages.rate) / outages.rate;
  auto skip = static_cast<std::size_t>(1500 + random.below(500));
  const auto spread = static_cast<std::uint64_t>(std::max(0, outages.longest - outages.shortest) + 1);
  for (bool out = false; good.size() < frames; out = !out) {
    const int length = !out                   ? geometric(random, mean_between)
                       : outages.longest == 0 ? geometric(random, outages.shortest)
                                              : outages.shortest + static_cast<int>(random.below(spread));
    for (int i = 0; i < length && good.size() < frames; ++i) {
      if (skip > 0)
        --skip;
      else
        good.push_back(out || random.chance(outages.flicker) ? 0 : 1);
    }
  }
  return good;
}

inline RatioSeries share_of_frames(std::vector<double> good) {
  std::vector<double> whole(good.size(), 1.0);
  return {std::move(good), std::move(whole)};
}

/// How often an interval was told, and how often it then held the truth.
struct Coverage {
  std::size_t asked = 0, told = 0, covered = 0;
  double width = 0;  ///< sum over those told

  void add(const std::optional<Interval>& interval, double truth) {
    ++asked;
    if (!interval) return;
    ++told;
    covered += interval->low <= truth && truth <= interval->high ? 1 : 0;
    width += interval->high - interval->low;
  }
  double percent() const { return 100 * static_cast<double>(covered) / static_cast<double>(told); }
};

}  // namespace relock
