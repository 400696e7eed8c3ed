#include "eval/compatibility/vot_multistart.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "eval/compatibility/overlap.h"

namespace relock {
namespace {

std::vector<double> overlaps_of(const AnsweredSequence& run) {
  std::vector<double> overlaps(run.frames.size(), 0.0);
  for (std::size_t i = 1; i < overlaps.size(); ++i) {
    const AnsweredFrame& frame = run.frames[i];
    if (frame.answer && frame.truth) overlaps[i] = vot_overlap(*frame.answer, *frame.truth, run.picture);
  }
  return overlaps;
}

/// Frames before the failure; all of them when there is none.
std::size_t progress_of(const AnsweredSequence& run, const std::vector<double>& overlaps,
                        const VotMultistartOptions& options) {
  std::size_t misses = 0;
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    misses = overlaps[i] <= options.threshold && run.frames[i].truth ? misses + 1 : 0;
    if (misses == options.grace) return i + 1 - options.grace;
  }
  return overlaps.size();
}

/// The mean overlap of a run's first frames, by their number, the anchor's left out.
class ExpectedOverlap {
 public:
  explicit ExpectedOverlap(std::size_t lengths) : sum_(lengths), runs_(lengths) {}

  /// Beyond its end a run that failed counts on; its sum is divided by one frame less than its length has, as in
  /// the toolkit.
  void add(const std::vector<double>& overlaps, bool failed) {
    double so_far = 0;
    for (std::size_t length = 1; length < sum_.size(); ++length) {
      const bool inside = length < overlaps.size();
      if (!inside && !failed) return;
      if (inside) so_far += overlaps[length];
      const std::size_t frames = inside ? length : length - 1;
      sum_[length] += frames > 0 ? so_far / static_cast<double>(frames) : 0.0;
      ++runs_[length];
    }
  }
  std::vector<double> curve() const {
    std::vector<double> means(sum_.size());
    for (std::size_t i = 0; i < means.size(); ++i)
      if (runs_[i] > 0) means[i] = sum_[i] / static_cast<double>(runs_[i]);
    return means;
  }
  bool reaches(std::size_t length) const { return length < runs_.size() && runs_[length] > 0; }

 private:
  std::vector<double> sum_;
  std::vector<std::size_t> runs_;
};

/// What the runs of one recording add up to, frames.
struct Share {
  double length = 0;  ///< of the recording
  double lasted = 0, total = 0;
};

double robustness_of(const std::map<std::string, Share>& shares) {
  double robustness = 0, weight = 0;
  for (const auto& [name, share] : shares) {
    robustness += share.length * share.lasted / share.total;
    weight += share.length;
  }
  return robustness / weight;
}

}  // namespace

VotMultistartScores vot_multistart_scores(std::span<const AnsweredSequence> runs,
                                          const VotMultistartOptions& options) {
  VotMultistartScores scores;
  ExpectedOverlap expected(options.eao_high);
  std::map<std::string, Share> shares;
  double overlap = 0, lasted = 0;
  for (const AnsweredSequence& run : runs) {
    std::vector<double> overlaps = overlaps_of(run);
    const std::size_t progress = progress_of(run, overlaps, options);
    const bool failed = progress < overlaps.size();
    std::fill(overlaps.begin() + static_cast<std::ptrdiff_t>(progress), overlaps.end(), 0.0);
    expected.add(overlaps, failed);
    overlap += std::accumulate(overlaps.begin(), overlaps.end(), 0.0);
    lasted += static_cast<double>(progress);
    Share& share = shares[run.name];
    share.length = static_cast<double>(run.first_frame + run.frames.size());
    share.lasted += static_cast<double>(progress);
    share.total += static_cast<double>(overlaps.size());
    scores.failures += failed ? 1 : 0;
    ++scores.runs;
  }
  if (scores.runs == 0) return scores;
  scores.accuracy = lasted > 0 ? overlap / lasted : 0.0;
  scores.robustness = robustness_of(shares);
  scores.expected_overlap = expected.curve();
  if (!expected.reaches(options.eao_low)) return scores;
  const auto from = scores.expected_overlap.begin() + static_cast<std::ptrdiff_t>(options.eao_low);
  scores.eao = std::accumulate(from, scores.expected_overlap.end(), 0.0) /
               static_cast<double>(options.eao_high - options.eao_low);
  return scores;
}

}  // namespace relock
