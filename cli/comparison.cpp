#include "cli/comparison.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace relock {
namespace {

/// Frames on which every method that was asked about the target, yardsticks apart, has a Hit that tells how exact it
/// is. One whose label stems from one of them is there for none.
std::vector<bool> common_hits(const ScoredComparison& comparison, std::size_t target) {
  const auto& runs = comparison.stored.runs;
  std::vector<bool> common(comparison.stored.recording.frames(), true);
  bool any = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].record.yardstick || !runs[i].trajectory.judged_from[target]) continue;
    any = true;
    std::vector<bool> fixed(common.size());
    for (const Fix& fix : comparison.tallies[i][target].tally.fixes) fixed[fix.frame] = true;
    for (std::size_t frame = 0; frame < common.size(); ++frame)
      if (!fixed[frame]) common[frame] = false;
  }
  if (!any) common.assign(common.size(), false);
  return common;
}

std::vector<Fix> those_in(const std::vector<bool>& common, std::vector<Fix> all) {
  std::erase_if(all, [&](const Fix& fix) { return !common[fix.frame]; });
  return all;
}

}  // namespace

ScoredComparison scored(StoredComparison stored, const Gate& gate) {
  ScoredComparison result{std::move(stored), gate, {}, {}, {}, {}};
  const Recording& recording = result.stored.recording;
  for (const StoredRun& run : result.stored.runs) {
    result.evaluations.push_back(evaluate(recording, run.trajectory, gate));
    const Evaluation& evaluation = result.evaluations.back();
    result.tallies.push_back(tally_targets(recording, run.trajectory, evaluation));
    result.sheets.push_back(score(recording, evaluation, result.tallies.back()));
  }
  result.common.assign(result.stored.runs.size(), std::vector<std::vector<Fix>>(recording.targets.size()));
  for (std::size_t t = 0; t < recording.targets.size(); ++t) {
    const auto common = common_hits(result, t);
    for (std::size_t run = 0; run < result.stored.runs.size(); ++run)
      result.common[run][t] = those_in(common, result.tallies[run][t].tally.fixes);
  }
  return result;
}

Gate gate_of(const StoredComparison& comparison, const std::optional<std::string>& asked) {
  const std::string& of_resets = comparison.runs.front().record.gate;
  const Gate gate = asked ? parse_gate(*asked) : of_resets == to_string(Gate::iou()) ? Gate::iou() : Gate{};
  if (!of_resets.empty() && of_resets != to_string(gate))
    throw Error(fmt::format("the resets in {} were judged by the gate {}; leave out --gate {}",
                            comparison.folder.string(), of_resets, asked.value_or("")));
  return gate;
}

std::size_t recorded_frame(const StoredComparison& comparison, const StoredRun& run, std::size_t frame) {
  const auto& anchor = run.record.anchor;
  if (!anchor || anchor->direction == Direction::forward) return frame;
  return std::max(comparison.recorded_frames, comparison.recording.frames()) - 1 - frame;
}

std::optional<std::string> end_of_recording(const StoredComparison& comparison) {
  for (const StoredRun& run : comparison.runs)
    if (run.record.cut_short)
      return fmt::format("{} could not be read beyond frame {}: {}", comparison.recording.name,
                         run.record.cut_short->frame, run.record.cut_short->what);
  return {};
}

std::string heading(const StoredComparison& comparison, const Gate& gate) {
  const RunRecord& record = comparison.runs.front().record;
  const std::string gaps =
      record.gaps == "none" ? "as recorded" : fmt::format("gaps {} (seed {})", record.gaps, record.seed);
  return fmt::format("{}, {}, {}, gate {}", comparison.recording.name, gaps, spoken(record.showing()),
                     to_string(gate));
}

}  // namespace relock
