#include "eval/statistics/long_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace relock {
namespace {

using Series = std::vector<double>;

/// More waves than these narrow an interval by 3 % at most and let frequencies in that tell other things.
constexpr double kMostWaves = 24;
/// A wave is slow when it takes this many decorrelation times.
constexpr double kSlow = 7;
/// Only slow waves are looked for, so longer sequences are summed up into this many bins first.
constexpr std::size_t kMostBins = 512;

double sum(const Series& series) { return std::accumulate(series.begin(), series.end(), 0.0); }

/// Σ of e(i) e(i + lag) within the sequences.
double product_sum(std::span<const Series> sequences, std::size_t lag) {
  double total = 0;
  for (const Series& e : sequences)
    for (std::size_t i = lag; i < e.size(); ++i) total += e[i] * e[i - lag];
  return total;
}

/// Time in frames over which the autocorrelation falls to 1/e: the slowest decay that any of a few lags shows,
/// so that a detector that flickers does not hide its long outages.
double decorrelation_time(std::span<const Series> sequences) {
  std::vector<Series> telling;
  std::size_t frames = 0, told = 0;
  for (const Series& e : sequences) {
    Series kept;
    std::copy_if(e.begin(), e.end(), std::back_inserter(kept), [](double v) { return v != 0; });
    frames += e.size();
    told += kept.size();
    telling.push_back(std::move(kept));
  }
  const double power = product_sum(telling, 0);
  if (told == 0 || power <= 0) return 0;
  const double noise = 2 / std::sqrt(static_cast<double>(told));
  double slowest = 0;
  for (const std::size_t lag : {1u, 2u, 4u, 8u, 16u}) {
    const double correlation = product_sum(telling, lag) / power;
    if (correlation > noise)
      slowest = std::max(slowest, -static_cast<double>(lag) / std::log(std::min(correlation, 0.999)));
  }
  return slowest * static_cast<double>(frames) / static_cast<double>(told);
}

/// How often the sequences fall below zero after having been above.
std::size_t excursions(std::span<const Series> sequences) {
  std::size_t count = 0;
  for (const Series& e : sequences) {
    bool below = false;
    for (const double v : e) {
      if (v < 0 && !below) ++count;
      if (v != 0) below = v < 0;
    }
  }
  return count;
}

Series binned(const Series& e) {
  if (e.size() <= kMostBins) return e;
  Series bins(kMostBins, 0.0);
  for (std::size_t i = 0; i < e.size(); ++i) bins[i * kMostBins / e.size()] += e[i];
  return bins;
}

/// Σ over the first `waves` cosines of the squared transform, each of the expectation of the squared sum.
double wave_power(const Series& e, int waves) {
  const Series bins = binned(e);
  const double step = std::numbers::pi / static_cast<double>(bins.size());
  double power = 0;
  for (int wave = 1; wave <= waves; ++wave) {
    // cos((i + 1/2) a) by the recurrence of Chebyshev
    const double angle = step * wave, twice = 2 * std::cos(angle);
    double now = std::cos(angle / 2), before = now, transform = 0;
    for (const double v : bins) {
      transform += v * now;
      const double next = twice * now - before;
      before = now;
      now = next;
    }
    power += 2 * transform * transform;
  }
  return power;
}

std::optional<LongRunVariance> between(std::span<const Series> sequences) {
  double squares = 0;
  std::size_t above = 0, below = 0;
  for (const Series& e : sequences) {
    const double total = sum(e);
    squares += total * total;
    above += total > 0 ? 1 : 0;
    below += total < 0 ? 1 : 0;
  }
  if (std::min(above, below) < kLeastSequences) return {};
  const auto count = static_cast<double>(sequences.size());
  return LongRunVariance{squares * count / (count - 1), count - 1};
}

std::optional<LongRunVariance> within(std::span<const Series> sequences) {
  if (excursions(sequences) < kLeastOutages) return {};
  const double time = decorrelation_time(sequences);
  LongRunVariance found;
  double spread = 0;  // Σ variance² / freedom: Satterthwaite's
  for (const Series& e : sequences) {
    if (e.empty()) continue;
    const double frames = static_cast<double>(e.size());
    const double waves = std::floor(std::min({kMostWaves, frames / 4, frames / (kSlow * time)}));
    if (waves < 1) return {};
    const double variance = wave_power(e, static_cast<int>(waves)) / waves;
    found.variance += variance;
    spread += variance * variance / waves;
  }
  if (spread <= 0) return {};
  found.freedom = found.variance * found.variance / spread;
  if (found.freedom < kLeastFreedom) return {};
  return found;
}

}  // namespace

std::optional<LongRunVariance> long_run_variance(std::span<const Series> sequences) {
  return sequences.size() >= kManySequences ? between(sequences) : within(sequences);
}

}  // namespace relock
