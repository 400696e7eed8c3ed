#include "eval/compatibility/got10k.h"

#include <numeric>

#include "eval/compatibility/overlap.h"
#include "eval/compatibility/success.h"

namespace relock {
namespace {

constexpr int kThresholds = 101;

bool compared(const AnsweredFrame& frame) { return frame.truth && frame.visible_fraction > 0; }

double overlap(const AnsweredFrame& frame, Size picture) {
  return frame.answer ? got10k_overlap(bounds(*frame.answer), bounds(*frame.truth), picture) : 0.0;
}

}  // namespace

Got10kScores got10k_scores(std::span<const AnsweredSequence> sequences) {
  std::vector<double> overlaps;
  for (const AnsweredSequence& sequence : sequences)
    for (std::size_t i = 1; i < sequence.frames.size(); ++i)
      if (compared(sequence.frames[i])) overlaps.push_back(overlap(sequence.frames[i], sequence.picture));
  Got10kScores scores;
  scores.frames = overlaps.size();
  if (overlaps.empty()) return scores;
  scores.ao = std::accumulate(overlaps.begin(), overlaps.end(), 0.0) / static_cast<double>(overlaps.size());
  scores.sr50 = share_above(overlaps, 0.5);
  scores.sr75 = share_above(overlaps, 0.75);
  for (int k = 0; k < kThresholds; ++k) scores.success.push_back(share_above(overlaps, k * 0.01));
  return scores;
}

}  // namespace relock
