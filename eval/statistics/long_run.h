#pragma once

#include <optional>
#include <span>
#include <vector>

namespace relock {

/// How uncertain a sum over dependent frames is.
struct LongRunVariance {
  double variance = 0;  ///< of the sum of the series
  double freedom = 0;   ///< degrees of freedom behind it: how well the variance itself is known
};

/// For so many sequences and more, sequences are what is independent; for fewer, stretches of frames are.
constexpr std::size_t kManySequences = 10;

/// The variance of Σ over all frames of all sequences of a series whose expectation is zero, frame after frame.
///
/// From kManySequences on: from the scatter of the sequences' sums; nothing where fewer than kLeastSequences lie on
/// either side of zero. Below: from the slow waves within each sequence, its first cosine transforms (Müller 2007;
/// Lazarus, Lewis, Stock and Watson 2018). A wave longer than any outage is as uncertain as the sum itself, and
/// each is worth one degree of freedom; how many waves are that long is decided from how slowly the
/// autocorrelation decays. Nothing where the frames hold fewer than kLeastFreedom such waves, or fewer than
/// kLeastOutages stretches below zero.
std::optional<LongRunVariance> long_run_variance(std::span<const std::vector<double>> sequences);

constexpr double kLeastFreedom = 3;
constexpr std::size_t kLeastOutages = 5;
constexpr std::size_t kLeastSequences = 3;

}  // namespace relock
