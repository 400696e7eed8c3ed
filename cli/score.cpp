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
#include "cli/scores/print.h"
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
    if (arguments.cost) read.pools.back().add_costs(compared, read_costs(compared.stored));
    if (const auto end = end_of_recording(compared.stored)) read.ends.push_back(*end);
  } catch (const Error& fault) {
    note(fault.what());
  }
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
      print_tables(tables, TableFormat::markdown, read.ends);
      break;
    case ScoreFormat::latex:
      print_tables(tables, TableFormat::latex, read.ends);
      break;
    case ScoreFormat::text:
      print_tables(tables, TableFormat::text, read.ends);
      break;
  }
  return tell_left_out(read.unreadable);
}

}  // namespace relock
