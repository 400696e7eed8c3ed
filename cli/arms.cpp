#include "cli/arms.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

#include "cli/comparison.h"
#include "core/error.h"
#include "eval/scores/common_frames.h"

namespace relock {
namespace {

template <class Value>
void add_new(std::vector<Value>& all, const Value& value) {
  if (std::find(all.begin(), all.end(), value) == all.end()) all.push_back(value);
}

bool as_recorded(const StoredComparison& comparison) { return conditions_of(comparison).gaps == "none"; }

const StoredRun* run_of(const StoredComparison& comparison, const std::string& method) {
  const auto found = std::find_if(comparison.runs.begin(), comparison.runs.end(),
                                  [&](const StoredRun& run) { return run.record.method == method; });
  return found == comparison.runs.end() ? nullptr : &*found;
}

/// Made under the same conditions but for the gaps.
bool alike(const StoredComparison& a, const StoredComparison& b) {
  const RunRecord &one = conditions_of(a), &other = conditions_of(b);
  return one.seed == other.seed && one.recording == other.recording && one.fingerprint == other.fingerprint &&
         one.gate == other.gate && one.showing() == other.showing();
}

/// OUT of OUT/RECORDING/GAPS-PROTOCOL.
std::filesystem::path results_root(const StoredComparison& comparison) {
  return comparison.folder.parent_path().parent_path();
}

/// The run of `method` as recorded that the one in `with` is compared to: that in the same results if it is there,
/// else the first of the others. Nothing when there is none.
const StoredRun* run_without(const std::vector<StoredComparison>& all, const StoredComparison& with,
                             const std::string& method) {
  const StoredRun* elsewhere = nullptr;
  for (const StoredComparison& other : all) {
    if (!as_recorded(other) || !alike(other, with)) continue;
    const StoredRun* run = run_of(other, method);
    if (run && results_root(other) == results_root(with)) return run;
    if (!elsewhere) elsewhere = run;
  }
  return elsewhere;
}

}  // namespace

const RunRecord& conditions_of(const StoredComparison& comparison) { return comparison.runs.front().record; }

std::vector<std::vector<Arms>> arms_by_pattern(const std::vector<StoredComparison>& comparisons) {
  std::map<std::tuple<std::string, Showing, std::string>, std::vector<Arms>> by_pattern;
  for (const StoredComparison& with : comparisons) {
    if (as_recorded(with)) continue;
    const RunRecord& record = conditions_of(with);
    for (const StoredRun& run : with.runs)
      if (const StoredRun* without = run_without(comparisons, with, run.record.method))
        by_pattern[{record.gaps, record.showing(), record.gate}].push_back({with, *without, run});
  }
  if (by_pattern.empty())
    throw Error(
        "no runs there were made with gaps and as recorded, too, with the same seed; `relock run --gaps "
        "PATTERN --paired` makes both");
  std::vector<std::vector<Arms>> patterns;
  for (const auto& [pattern, arms] : by_pattern) patterns.push_back(arms);
  return patterns;
}

PairedConditions paired_conditions(const std::vector<Arms>& all, const std::optional<std::string>& gate) {
  const StoredComparison& first = all.front().conditions;
  const RunRecord& record = conditions_of(first);
  PairedConditions conditions{record.gaps, record.showing(), gate_of(first, gate), {}, {}};
  for (const Arms& arms : all) {
    add_new(conditions.recordings, arms.conditions.recording.name);
    add_new(conditions.seeds, arms.with.record.seed);
  }
  return conditions;
}

std::string to_string(const PairedConditions& c) {
  return fmt::format("seed{} {}, {}, gate {}", c.seeds.size() == 1 ? "" : "s", fmt::join(c.seeds, ", "),
                     spoken(c.showing), to_string(c.gate));
}

Json json_of(const PairedConditions& c) {
  return {{"gaps", c.gaps},
          {"protocol", to_string(c.showing.protocol)},
          {"start", c.showing.anchor ? Json(to_string(*c.showing.anchor)) : Json()},
          {"real_time", c.showing.real_time},
          {"latency", c.showing.latency},
          {"gate", to_string(c.gate)},
          {"recordings", c.recordings},
          {"seeds", c.seeds}};
}

std::vector<std::string> without_a_pair(const std::vector<StoredComparison>& comparisons) {
  std::vector<std::string> sentences;
  for (const StoredComparison& with : comparisons) {
    if (as_recorded(with)) continue;
    std::vector<std::string> alone;
    for (const StoredRun& run : with.runs)
      if (!run_without(comparisons, with, run.record.method)) alone.push_back(run.record.method);
    if (alone.empty()) continue;
    const RunRecord& record = conditions_of(with);
    const std::string what =
        alone.size() == with.runs.size() ? "it" : fmt::format("{}", fmt::join(alone, ", "));
    sentences.push_back(fmt::format("{} with gaps {}, seed {}, {}: there is no run of {} as recorded",
                                    record.recording, record.gaps, record.seed, spoken(record.showing()),
                                    what));
  }
  return sentences;
}

EquallyLong equally_long(const Arms& arms) {
  const Recording& recording = arms.conditions.recording;
  const std::size_t frames = std::min(
      {recording.frames(), arms.without.trajectory.frames.size(), arms.with.trajectory.frames.size()});
  return {up_to(recording, frames), up_to(arms.without.trajectory, frames),
          up_to(arms.with.trajectory, frames)};
}

}  // namespace relock
