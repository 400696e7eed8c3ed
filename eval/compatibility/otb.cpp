#include "eval/compatibility/otb.h"

#include <numeric>

#include "eval/compatibility/overlap.h"
#include "eval/compatibility/success.h"

namespace relock {
namespace {

constexpr int kOverlapThresholds = 21;
constexpr int kErrorThresholds = 51;

struct Compared {
  std::vector<double> overlaps;
  std::vector<double> errors_px;
};

bool annotated(const std::optional<Outline>& truth) {
  if (!truth) return false;
  const Box box = one_based(bounds(*truth));
  return box.x > 0 && box.y > 0 && box.width > 0 && box.height > 0;
}

Compared compare(const AnsweredSequence& sequence) {
  Compared compared;
  std::optional<Outline> answer;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const AnsweredFrame& frame = sequence.frames[i];
    if (i == 0) answer = frame.truth;
    if (i > 0 && frame.answer) answer = frame.answer;
    const bool comparable = annotated(frame.truth) && answer;
    const Box said = comparable ? bounds(*answer) : Box{}, truth = comparable ? bounds(*frame.truth) : Box{};
    compared.overlaps.push_back(comparable ? otb_overlap(said, truth) : -1);
    compared.errors_px.push_back(comparable ? norm(centre_of(said) - centre_of(truth)) : -1);
  }
  return compared;
}

}  // namespace

OtbScores otb_scores(std::span<const AnsweredSequence> sequences) {
  OtbScores scores;
  scores.success.resize(kOverlapThresholds);
  scores.precision.resize(kErrorThresholds);
  for (const AnsweredSequence& sequence : sequences) {
    if (sequence.frames.empty()) continue;
    const Compared compared = compare(sequence);
    for (std::size_t k = 0; k < kOverlapThresholds; ++k)
      scores.success[k] += share_above(compared.overlaps, static_cast<double>(k) * 0.05);
    for (std::size_t k = 0; k < kErrorThresholds; ++k)
      scores.precision[k] += share_within(compared.errors_px, static_cast<double>(k));
    ++scores.sequences;
  }
  if (scores.sequences == 0) return {};
  for (double& share : scores.success) share /= static_cast<double>(scores.sequences);
  for (double& share : scores.precision) share /= static_cast<double>(scores.sequences);
  scores.auc = std::accumulate(scores.success.begin(), scores.success.end(), 0.0) / kOverlapThresholds;
  scores.success_rate = scores.success[kOverlapThresholds / 2];
  scores.precision_20 = scores.precision[20];
  return scores;
}

}  // namespace relock
