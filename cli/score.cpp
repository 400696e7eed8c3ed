// `relock score`: scores every run below the given folders, writes the scores beside it and prints the tables.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "cli/comparison.h"
#include "cli/files.h"
#include "cli/readable.h"
#include "cli/scores/files.h"
#include "cli/scores/tables.h"
#include "cli/verbs.h"
#include "eval/events_csv.h"

namespace relock {
namespace {

void store_scores(const ScoredComparison& compared, std::size_t i) {
  const StoredRun& run = compared.stored.runs[i];
  const Recording& recording = compared.stored.recording;
  std::ostringstream events, verdicts;
  write_events(events, recording, run.trajectory, compared.evaluations[i]);
  write_verdicts(verdicts, recording, compared.evaluations[i]);
  write_file(run.folder / "events.csv", events.str());
  write_file(run.folder / "verdicts.csv", verdicts.str());
  write_file(run.folder / "scores.json", scores_json(run, recording, compared.gate, compared.sheets[i]));
}

/// What tables are made of, and what could not be read.
struct Read {
  std::vector<ScorePool> pools;
  std::vector<std::string> ends;  ///< of recordings that could not be read on
  std::vector<std::string> unreadable;
  KnownRecordings known;
};

/// A run that is found below several folders counts once.
std::vector<FoundComparison> found_below(const std::vector<std::filesystem::path>& folders) {
  std::map<std::filesystem::path, std::set<std::filesystem::path>> runs_of;  // by comparison
  for (const auto& folder : folders)
    for (const FoundComparison& found : find_results(folder))
      runs_of[found.folder].insert(found.runs.begin(), found.runs.end());
  std::vector<FoundComparison> all;
  for (const auto& [comparison, runs] : runs_of) all.push_back({comparison, {runs.begin(), runs.end()}});
  return all;
}

/// Recordings are folders of comparisons.
std::size_t recordings_in(const std::vector<FoundComparison>& found) {
  std::set<std::string> names;
  for (const FoundComparison& comparison : found)
    names.insert(comparison.folder.parent_path().filename().string());
  return names.size();
}

std::vector<std::vector<FrameCost>> costs_of(const StoredComparison& stored) {
  std::vector<std::vector<FrameCost>> all;
  for (const StoredRun& run : stored.runs) all.push_back(read_costs(run.folder));
  return all;
}

/// One comparison at a time: what is kept of it is its sums.
void read_one(const FoundComparison& found, const ScoreArguments& arguments, Read& read) {
  // All comparisons on a recording have its truth, and whatever is wrong with it, in common.
  const auto note = [&](const std::string& why) {
    if (std::ranges::find(read.unreadable, why) == read.unreadable.end()) read.unreadable.push_back(why);
  };
  auto stored = read_comparison(found, note);
  if (!stored) return;
  try {
    read.known.check(*stored);
    const Gate used = gate_of(*stored, arguments.gate);
    const ScoredComparison compared = scored(*std::move(stored), used);
    for (std::size_t i = 0; i < compared.stored.runs.size(); ++i) store_scores(compared, i);
    for (ScorePool& pool : read.pools) pool.add(compared);
    if (arguments.cost) read.pools.back().add_costs(compared, costs_of(compared.stored));
    if (const auto end = end_of_recording(compared.stored)) read.ends.push_back(*end);
  } catch (const Error& fault) {
    note(fault.what());
  }
}

std::vector<JudgedTable> judged_tables(std::vector<ScorePool> pools) {
  std::vector<JudgedTable> all;
  for (ScorePool& pool : pools)
    for (ScoreTable& table : std::move(pool).tables()) {
      auto methods = judged(table);
      all.push_back({std::move(table), std::move(methods)});
    }
  std::stable_sort(all.begin(), all.end(), [](const JudgedTable& a, const JudgedTable& b) {
    return a.table.conditions < b.table.conditions;
  });
  return all;
}

/// With one recording its targets matter; with several, all of them together.
void keep_targets_of_single_recordings(std::vector<JudgedTable>& tables) {
  std::set<TableConditions> several;
  for (const JudgedTable& judged : tables)
    if (judged.table.grouping == Grouping::none && judged.table.recordings.size() > 1)
      several.insert(judged.table.conditions);
  std::erase_if(tables, [&](const JudgedTable& judged) {
    return judged.table.grouping == Grouping::target && several.contains(judged.table.conditions);
  });
}

// --- What a person reads.

/// What qualifies the scores of one method, in sentences.
std::vector<std::string> remarks(const ScoreTable& table, std::size_t i, const Scores& s) {
  const MethodPool& method = table.methods[i];
  std::vector<std::string> all;
  std::size_t most = 0;
  for (const MethodPool& other : table.methods) most = std::max(most, other.scored_on.size());
  if (!method.failures.empty())
    all.push_back(fmt::format("{} failed on frame {}: {}; {} visible frames after it count as Misses",
                              method.method, method.failures[0].frame, method.failures[0].what, s.failed));
  if (s.spurious > 0) all.push_back(fmt::format("{}: {} spurious sightings", method.method, s.spurious));
  if (s.uncoded > 0) all.push_back(fmt::format("{}: {} Hits without a code", method.method, s.uncoded));
  if (!method.deterministic)
    all.push_back(fmt::format("{} answers differently from run to run: its scores are of {}", method.method,
                              method.runs == 1 ? "one run" : fmt::format("{} runs", method.runs)));
  if (method.targets() < table.targets())
    all.push_back(
        fmt::format("{} is scored on {} of {} targets: compare it with others in --by target or recording",
                    method.method, method.targets(), table.targets()));
  else if (method.scored_on.size() < most)
    all.push_back(fmt::format("{} was shown fewer patterns of frames than others (fewer seeds or starts)",
                              method.method));
  return all;
}

/// Whether anything could be hit there.
bool has_frames(const ScoreTable& table) {
  return std::any_of(table.methods.begin(), table.methods.end(),
                     [](const MethodPool& method) { return method.tally.sum.could_hit > 0; });
}

bool has_costs(const ScoreTable& table) {
  return std::any_of(table.methods.begin(), table.methods.end(),
                     [](const MethodPool& method) { return !method.costs.empty(); });
}

class Printer {
 public:
  explicit Printer(TableFormat format) : format_(format) {}

  /// Those of the same conditions, from `begin` on; returns their end.
  std::size_t print(const std::vector<JudgedTable>& all, std::size_t begin) {
    std::size_t end = begin;
    while (end < all.size() && all[end].table.conditions == all[begin].table.conditions) ++end;
    const auto pooled = std::find_if(all.begin() + offset(begin), all.begin() + offset(end),
                                     [](const auto& t) { return t.table.grouping == Grouping::none; });
    title(pooled->table);
    print_groups(all, begin, end);
    if (end - begin == 1 || pooled->table.targets() > 1) print_one(*pooled, "all targets pooled");
    if (has_costs(pooled->table)) {
      subtitle("what it cost, all targets together");
      fmt::print("{}", cost_table(pooled->table).in(format_));
    }
    for (std::size_t i = 0; i < pooled->methods.size(); ++i)
      for (const std::string& remark : remarks(pooled->table, i, pooled->methods[i].scores))
        print_remark(remark);
    return end;
  }

 private:
  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  void title(const ScoreTable& table) {
    std::string text = heading(table);
    std::replace(text.begin(), text.end(), '\n', ' ');
    fmt::print("{}{}{}\n", first_ ? "" : "\n",
               format_ == TableFormat::markdown ? "## "
               : format_ == TableFormat::latex  ? "% "
                                                : "",
               text);
    first_ = false;
  }

  void print_remark(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    fmt::print("{}{}\n",
               format_ == TableFormat::latex      ? "% "
               : format_ == TableFormat::markdown ? "- "
                                                  : "  ",
               text);
  }

  void print_groups(const std::vector<JudgedTable>& all, std::size_t begin, std::size_t end) {
    std::vector<const JudgedTable*> bins;
    for (std::size_t i = begin; i < end; ++i) {
      const ScoreTable& table = all[i].table;
      if (table.grouping == Grouping::none) continue;
      if (table.grouping == Grouping::blur || table.grouping == Grouping::gap) {
        if (has_frames(table)) bins.push_back(&all[i]);
      } else {
        print_one(all[i], fmt::format("{} {}", to_string(table.grouping), table.group));
      }
    }
    if (bins.empty()) return;
    subtitle(bins.front()->table.grouping == Grouping::blur ? "recognition by length of the true blur"
                                                            : "recognition by the gap before the frame");
    fmt::print("{}", bins_table(bins).in(format_));
  }

  void print_one(const JudgedTable& judged, const std::string& what) {
    subtitle(what);
    fmt::print("{}\n{}", keeping_table(judged).in(format_), exactness_table(judged).in(format_));
    if (!judged.table.conditions.real_time.empty())
      fmt::print("\n{}", real_time_table(judged.table).in(format_));
  }

  void subtitle(const std::string& text) {
    fmt::print("\n{}{}\n",
               format_ == TableFormat::markdown ? "### "
               : format_ == TableFormat::latex  ? "% "
                                                : "  ",
               text);
    if (format_ == TableFormat::markdown) fmt::print("\n");
  }

  TableFormat format_;
  bool first_ = true;
};

void print_tables(const std::vector<JudgedTable>& tables, TableFormat format, const Read& read) {
  Printer printer(format);
  for (std::size_t i = 0; i < tables.size();) i = printer.print(tables, i);
  if (format != TableFormat::text || tables.empty()) return;
  for (const std::string& end : read.ends) fmt::print("  {}\n", end);
  fmt::print("{}", table_footnote());
  if (std::any_of(tables.begin(), tables.end(),
                  [](const JudgedTable& t) { return !t.table.conditions.real_time.empty(); }))
    fmt::print("{}", real_time_footnote());
}

}  // namespace

int score(const ScoreArguments& arguments) {
  if (arguments.gate) parse_gate(*arguments.gate);
  const auto found = found_below(arguments.folders);
  const std::size_t recordings = recordings_in(found);
  Read read;
  if (arguments.by)
    read.pools.emplace_back(parse_grouping(*arguments.by), recordings);
  else if (recordings < kRecordingsToResample)
    read.pools.emplace_back(Grouping::target, recordings);
  read.pools.emplace_back(Grouping::none, recordings);
  for (const FoundComparison& comparison : found) read_one(comparison, arguments, read);
  auto tables = judged_tables(std::move(read.pools));
  if (!arguments.by) keep_targets_of_single_recordings(tables);
  switch (arguments.format) {
    case ScoreFormat::json:
      fmt::print("{}", tables_json(tables));
      break;
    case ScoreFormat::csv:
      fmt::print("{}", tables_csv(tables));
      break;
    case ScoreFormat::markdown:
      print_tables(tables, TableFormat::markdown, read);
      break;
    case ScoreFormat::latex:
      print_tables(tables, TableFormat::latex, read);
      break;
    case ScoreFormat::text:
      print_tables(tables, TableFormat::text, read);
      break;
  }
  return tell_left_out(read.unreadable);
}

}  // namespace relock
