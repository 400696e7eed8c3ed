#include "eval/compatibility/vot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "eval/compatibility/overlap.h"

namespace relock {
namespace {

double overlap(const AnsweredFrame& frame, Size picture) {
  return frame.answer && frame.truth ? vot_overlap(*frame.answer, *frame.truth, picture) : 0.0;
}

/// Overlaps as the toolkit has them: 0 where the result file has a code in place of a region.
std::vector<double> overlaps_of(const AnsweredSequence& sequence, const std::vector<VotCode>& codes) {
  std::vector<double> all;
  for (std::size_t i = 0; i < codes.size(); ++i)
    all.push_back(codes[i] == VotCode::region ? overlap(sequence.frames[i], sequence.picture) : 0.0);
  return all;
}

double accuracy_of(const std::vector<double>& overlaps, const std::vector<VotCode>& codes,
                   std::size_t burn_in) {
  double sum = 0;
  std::size_t frames = 0, counts_from = 0;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (codes[i] == VotCode::start) counts_from = i + burn_in;
    if (codes[i] != VotCode::region || i < counts_from) continue;
    sum += overlaps[i];
    ++frames;
  }
  return frames > 0 ? sum / static_cast<double>(frames) : 0.0;
}

/// Overlaps from a start to the frame before the failure, or to the sequence's end.
struct Fragment {
  std::vector<double> overlaps;
  bool failed = false;
};

void add_fragments(const std::vector<double>& overlaps, const std::vector<VotCode>& codes,
                   std::vector<Fragment>& fragments) {
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (codes[i] != VotCode::start) continue;
    const auto ends = [](VotCode code) { return code == VotCode::failure; };
    const auto from = codes.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = std::find_if(from, codes.end(), ends);
    const auto at = [&](auto place) { return overlaps.begin() + (place - codes.begin()); };
    fragments.push_back({{at(from), at(end)}, end != codes.end()});
  }
}

/// Mean overlap of fragments by their length, starts left out. A fragment that failed goes on with zeros to the
/// longest one's length; one that did not counts as far as it goes.
std::vector<double> expected_overlap(const std::vector<Fragment>& fragments) {
  std::size_t longest = 0;
  for (const Fragment& fragment : fragments) longest = std::max(longest, fragment.overlaps.size());
  std::vector<double> sum(longest), count(longest);
  for (const Fragment& fragment : fragments) {
    double so_far = 0;
    const std::size_t end = fragment.failed ? longest : fragment.overlaps.size();
    for (std::size_t length = 0; length < end; ++length) {
      if (length > 0 && length < fragment.overlaps.size()) so_far += fragment.overlaps[length];
      if (length > 0) sum[length] += so_far / static_cast<double>(length);
      ++count[length];
    }
  }
  for (std::size_t length = 0; length < longest; ++length) sum[length] /= count[length];
  return sum;
}

std::optional<double> mean_between(const std::vector<double>& curve, std::size_t low, std::size_t high) {
  const std::size_t end = std::min(high + 1, curve.size());
  if (low >= end) return {};
  const auto at = [&](std::size_t i) { return curve.begin() + static_cast<std::ptrdiff_t>(i); };
  return std::accumulate(at(low), at(end), 0.0) / static_cast<double>(end - low);
}

/// The frame on which the fragment that begins at `start` failed; `next`: the next start, or the end.
std::optional<std::size_t> failure_between(const AnsweredSequence& sequence, std::size_t start,
                                           std::size_t next, std::size_t skip) {
  for (std::size_t i = start + 1; i < next; ++i)
    if (sequence.frames[i].judged && overlap(sequence.frames[i], sequence.picture) <= 0) return i;
  if (next == sequence.frames.size()) return {};
  return std::max(start + 1, next - std::min(next, skip));
}

}  // namespace

std::vector<VotCode> vot_codes(const AnsweredSequence& sequence, const VotOptions& options) {
  const std::size_t frames = sequence.frames.size();
  std::vector<VotCode> codes(frames, VotCode::nothing);
  const auto start_from = [&](std::size_t i) {
    while (i < frames && !sequence.frames[i].given) ++i;
    return i;
  };
  for (std::size_t start = start_from(0); start < frames;) {
    const std::size_t next = start_from(start + 1);
    const auto failure = failure_between(sequence, start, next, options.skip);
    codes[start] = VotCode::start;
    for (std::size_t i = start + 1; i < failure.value_or(next); ++i)
      if (sequence.frames[i].judged && sequence.frames[i].answer) codes[i] = VotCode::region;
    if (failure && *failure < next) codes[*failure] = VotCode::failure;
    start = next;
  }
  return codes;
}

VotScores vot_scores(std::span<const AnsweredSequence> sequences, const VotOptions& options) {
  VotScores scores;
  std::vector<Fragment> fragments;
  double accuracy = 0, failures = 0;
  for (const AnsweredSequence& sequence : sequences) {
    const std::vector<VotCode> codes = vot_codes(sequence, options);
    const std::vector<double> overlaps = overlaps_of(sequence, codes);
    const auto failed = std::count(codes.begin(), codes.end(), VotCode::failure);
    const auto length = static_cast<double>(codes.size());
    accuracy += length * accuracy_of(overlaps, codes, options.burn_in);
    failures += length * static_cast<double>(failed);
    scores.failures += static_cast<std::size_t>(failed);
    scores.frames += codes.size();
    add_fragments(overlaps, codes, fragments);
  }
  if (scores.frames == 0) return scores;
  const auto all = static_cast<double>(scores.frames);
  scores.accuracy = accuracy / all;
  scores.failures_mean = failures / all;
  const double mean_length = all / static_cast<double>(sequences.size());
  scores.robustness = std::exp(-options.sensitivity * *scores.failures_mean / mean_length);
  scores.expected_overlap = expected_overlap(fragments);
  scores.eao = mean_between(scores.expected_overlap, options.eao_low, options.eao_high);
  return scores;
}

}  // namespace relock
