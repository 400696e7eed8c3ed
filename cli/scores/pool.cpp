#include "cli/scores/pool.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"

namespace relock {
namespace {

constexpr std::pair<std::string_view, Grouping> kGroupings[] = {{"recording", Grouping::recording},
                                                                {"target", Grouping::target},
                                                                {"code", Grouping::code},
                                                                {"blur", Grouping::blur},
                                                                {"gap", Grouping::gap}};

/// The group that a target belongs to as a whole.
std::string group_of(Grouping grouping, const Recording& recording, const Target& target) {
  switch (grouping) {
    case Grouping::recording:
      return recording.name;
    case Grouping::target:
      return target.code ? fmt::format("{} ({})", target.id, to_string(*target.code)) : target.id;
    case Grouping::code:
      return target.code ? to_string(*target.code) : "without a code";
    default:
      return "";
  }
}

/// What could be hit in the frames of one bin, and was: all that a bin knows.
std::vector<Contribution> counts_in(const std::vector<Contribution>& all,
                                    const std::vector<std::size_t>& bins, std::size_t bin) {
  std::vector<Contribution> some(all.size());
  for (std::size_t frame = 0; frame < all.size(); ++frame) {
    if (bins[frame] != bin) continue;
    some[frame].could_hit = all[frame].could_hit;
    some[frame].hits = all[frame].hits;
  }
  return some;
}

MethodPool& pool_of(ScoreTable& table, const RunRecord& record) {
  const auto at = std::find_if(table.methods.begin(), table.methods.end(),
                               [&](const MethodPool& pool) { return pool.method == record.method; });
  if (at != table.methods.end()) return *at;
  MethodPool pool;
  pool.method = record.method;
  pool.yardstick = record.yardstick;
  pool.deterministic = record.deterministic;
  table.methods.push_back(std::move(pool));
  return table.methods.back();
}

/// Of each target; nothing where runs were not made in real time.
std::vector<RealTimeScores> real_time_scores(const ScoredComparison& compared, std::size_t run) {
  const StoredRun& stored = compared.stored.runs[run];
  if (stored.record.real_time.empty()) return {};
  return score_real_time(compared.stored.recording, stored.trajectory, stored.answers, compared.gate);
}

/// Which frames were shown, and from where: what makes two runs on a recording comparable frame by frame.
std::string shown(const RunRecord& record) {
  return fmt::format("{} {}", record.anchor ? to_string(*record.anchor) : "", fmt::join(record.dropped, ","));
}

bool asked(const ScoredComparison& compared, std::size_t run, std::size_t target) {
  return compared.stored.runs[run].trajectory.judged_from[target].has_value();
}

}  // namespace

std::string_view to_string(Grouping grouping) {
  for (const auto& [name, each] : kGroupings)
    if (each == grouping) return name;
  return "";
}

Grouping parse_grouping(std::string_view text) {
  for (const auto& [name, each] : kGroupings)
    if (name == text) return each;
  throw Error(fmt::format("--by {} is none; there are recording, target, code, blur and gap", text));
}

std::size_t MethodPool::targets() const {
  std::set<std::pair<std::string, std::string>> all;
  for (const auto& [recording, target, shown] : scored_on) all.insert({recording, target});
  return all.size();
}

std::size_t ScoreTable::targets() const {
  std::set<std::pair<std::string, std::string>> all;
  for (const MethodPool& method : methods)
    for (const auto& [recording, target, shown] : method.scored_on) all.insert({recording, target});
  return all.size();
}

void ScorePool::add(const ScoredComparison& compared) {
  const auto parts = parts_of(compared.stored.recording);
  for (std::size_t run = 0; run < compared.stored.runs.size(); ++run) {
    if (!known_.first(compared.stored.runs[run], compared.gate)) continue;
    MethodPool* pool = nullptr;
    const auto real_time = real_time_scores(compared, run);
    for (const Part& part : parts) {
      if (!asked(compared, run, part.target)) continue;
      pool = &pool_of(table_of(compared, part), compared.stored.runs[run].record);
      add_part(compared, run, part, *pool);
      if (!real_time.empty() && !part.bin) pool->real_time += real_time[part.target];
    }
    const bool all_targets = grouping_ == Grouping::none || grouping_ == Grouping::recording;
    if (pool != nullptr) ++pool->runs;
    if (pool != nullptr && all_targets) add_what_is_of_all_targets(compared, run, *pool);
  }
}

void ScorePool::add_costs(const ScoredComparison& compared,
                          const std::vector<std::vector<FrameCost>>& costs) {
  const auto parts = parts_of(compared.stored.recording);
  for (std::size_t run = 0; run < compared.stored.runs.size(); ++run) {
    // A run costs what it costs for all its targets together.
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const Part& each) { return asked(compared, run, each.target); });
    if (part == parts.end()) continue;
    MethodPool& pool = pool_of(table_of(compared, *part), compared.stored.runs[run].record);
    pool.costs.insert(pool.costs.end(), costs[run].begin(), costs[run].end());
  }
}

std::vector<ScorePool::Part> ScorePool::parts_of(const Recording& recording) const {
  std::vector<Part> parts;
  for (std::size_t t = 0; t < recording.targets.size(); ++t) {
    if (grouping_ == Grouping::blur) {
      for (std::size_t bin = 0; bin < kBlurBinCount; ++bin)
        parts.push_back({std::string(blur_bin_name(bin)), t, bin});
    } else if (grouping_ == Grouping::gap) {
      for (std::size_t bin = 0; bin < kGapBinCount; ++bin)
        parts.push_back({std::string(gap_bin_name(bin)), t, bin});
    } else {
      parts.push_back({group_of(grouping_, recording, recording.targets[t]), t});
    }
  }
  return parts;
}

ScoreTable& ScorePool::table_of(const ScoredComparison& compared, const Part& part) {
  const RunRecord& record = compared.stored.runs.front().record;
  const TableConditions conditions{std::string(to_string(record.protocol)), record.gaps,
                                   to_string(compared.gate), record.real_time, record.latency};
  ScoreTable& table = tables_[{conditions, part.bin.value_or(0), part.group}];
  table.conditions = conditions;
  table.grouping = grouping_;
  table.group = part.group;
  table.recordings.insert(compared.stored.recording.name);
  table.seeds.insert(record.seed);
  if (record.anchor) table.starts.insert(to_string(*record.anchor));
  return table;
}

void ScorePool::add_part(const ScoredComparison& compared, std::size_t run, const Part& part,
                         MethodPool& pool) const {
  const Recording& recording = compared.stored.recording;
  const TargetTally& one = compared.tallies[run][part.target];
  pool.scored_on.insert(
      {recording.name, recording.targets[part.target].id, shown(compared.stored.runs[run].record)});
  if (part.bin) {
    const auto bins = grouping_ == Grouping::blur
                          ? blur_bins(recording, part.target)
                          : gap_bins(recording, compared.evaluations[run].targets[part.target].judgements);
    const auto counts = counts_in(one.frames, bins, *part.bin);
    for (const Contribution& frame : counts) pool.tally.sum += frame;
    add_frames(compared, run, counts, pool);
    return;
  }
  pool.tally += one.tally;
  std::vector<FramedValue>& errors = pool.errors_px[recording.name];
  for (const Fix& fix : one.tally.fixes)
    errors.push_back(
        {recorded_frame(compared.stored, compared.stored.runs[run], fix.frame), norm(fix.error_px)});
  const std::vector<Fix>& common = compared.common[run][part.target];
  pool.common.insert(pool.common.end(), common.begin(), common.end());
  add_frames(compared, run, one.frames, pool);
}

void ScorePool::add_what_is_of_all_targets(const ScoredComparison& compared, std::size_t run,
                                           MethodPool& pool) const {
  const Evaluation& evaluation = compared.evaluations[run];
  const RunRecord& record = compared.stored.runs[run].record;
  pool.tally += tally_of_frames(compared.stored.recording, evaluation);
  std::vector<Contribution> spurious(compared.stored.recording.frames());
  add_spurious(spurious, evaluation);
  add_frames(compared, run, spurious, pool);
  if (!record.failures.empty()) pool.failures.push_back(record.failures.front());
}

void ScorePool::add_frames(const ScoredComparison& compared, std::size_t run,
                           const std::vector<Contribution>& frames, MethodPool& pool) const {
  std::vector<Contribution>& all = pool.frames[compared.stored.recording.name];
  if (grouping_ == Grouping::none && recordings_ >= kRecordingsToResample) {
    all.resize(1);
    for (const Contribution& frame : frames) all.front() += frame;
    return;
  }
  all.resize(std::max(all.size(), std::max(compared.stored.recorded_frames, frames.size())));
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    all[recorded_frame(compared.stored, compared.stored.runs[run], frame)] += frames[frame];
}

std::vector<ScoreTable> ScorePool::tables() && {
  std::vector<ScoreTable> all;
  for (auto& [key, table] : tables_) {
    std::stable_sort(table.methods.begin(), table.methods.end(),
                     [](const MethodPool& a, const MethodPool& b) {
                       return std::pair(a.yardstick, a.method) < std::pair(b.yardstick, b.method);
                     });
    all.push_back(std::move(table));
  }
  tables_.clear();
  return all;
}

}  // namespace relock
