#include "cli/comparison.h"

#include <fmt/format.h>

#include <algorithm>

namespace relock {
namespace {

/// Frames on which every method that was asked about the target, yardsticks apart, has a Hit.
std::vector<bool> common_hits(const ScoredComparison& comparison, std::size_t target) {
  const auto& runs = comparison.stored.runs;
  std::vector<bool> common(comparison.stored.recording.frames(), true);
  bool any = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].record.yardstick || !runs[i].trajectory.judged_from[target]) continue;
    any = true;
    const auto& judgements = comparison.evaluations[i].targets[target].judgements;
    for (std::size_t frame = 0; frame < common.size(); ++frame)
      if (judgements[frame].verdict != Verdict::Hit) common[frame] = false;
  }
  if (!any) common.assign(common.size(), false);
  return common;
}

Localization localize_common(const ScoredComparison& comparison, std::size_t run, std::size_t target,
                             const std::vector<bool>& common) {
  const StoredComparison& stored = comparison.stored;
  auto all = fixes(stored.recording, stored.runs[run].trajectory, comparison.evaluations[run], target);
  std::erase_if(all, [&](const Fix& fix) { return !common[fix.frame]; });
  return localize(all, 0);
}

}  // namespace

ScoredComparison scored(StoredComparison stored, const Gate& gate) {
  ScoredComparison result{std::move(stored), gate, {}, {}, {}};
  const Recording& recording = result.stored.recording;
  for (const StoredRun& run : result.stored.runs) {
    result.evaluations.push_back(evaluate(recording, run.trajectory, gate));
    result.sheets.push_back(score(recording, run.trajectory, result.evaluations.back()));
  }
  result.common.assign(result.stored.runs.size(), std::vector<Localization>(recording.targets.size()));
  for (std::size_t t = 0; t < recording.targets.size(); ++t) {
    const auto common = common_hits(result, t);
    for (std::size_t run = 0; run < result.stored.runs.size(); ++run)
      result.common[run][t] = localize_common(result, run, t, common);
  }
  return result;
}

std::string heading(const StoredComparison& comparison, const Gate& gate) {
  const RunRecord& record = comparison.runs.front().record;
  const std::string gaps =
      record.gaps == "none" ? "as recorded" : fmt::format("gaps {} (seed {})", record.gaps, record.seed);
  return fmt::format("{}, {}, protocol {}, gate {}", comparison.recording.name, gaps,
                     to_string(record.protocol), to_string(gate));
}

}  // namespace relock
