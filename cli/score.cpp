// `relock score`: scores every run below a folder, writes the scores beside it and prints the tables.

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "cli/comparison.h"
#include "cli/files.h"
#include "cli/real_time.h"
#include "cli/score_json.h"
#include "cli/table.h"
#include "cli/verbs.h"
#include "eval/events_csv.h"

namespace relock {
namespace {

constexpr std::string_view kFootnote = R"(
  recover s: Kaplan-Meier median, > where no more than half recovered while watched. e px, p95, % D: position error over Hits,
  < where it is below the accuracy of the labels (two standard deviations). common e: over Hits common to all methods.
)";

std::string cell(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "n/a";
}

/// Localization finer than two standard deviations of the labels says nothing of the method.
std::string fix_cell(const Localization& l, const std::optional<double>& px) {
  if (px && l.label_sigma_px && *px < 2 * *l.label_sigma_px)
    return fmt::format("<{:.2f}", 2 * *l.label_sigma_px);
  return cell(px, 2);
}

std::string recovery_cell(const Recovery& r) {
  if (r.losses == 0) return "-";
  if (r.median_s) return fmt::format("{:.2f}", *r.median_s);
  return fmt::format(">{:.2f}", r.follow_up_s);
}

std::vector<std::string> row(const std::string& name, const Scores& s, const Localization& common) {
  return {name,
          cell(s.recognition, 3),
          cell(s.precision, 3),
          cell(s.availability, 3),
          cell(s.availability_of_ceiling, 3),
          cell(s.locked_share, 3),
          cell(s.locked_share_of_ceiling, 3),
          std::to_string(s.losses),
          cell(s.losses_per_minute, 1),
          recovery_cell(s.recovery),
          fix_cell(s.localization, s.localization.median_px),
          fix_cell(s.localization, s.localization.p95_px),
          cell(s.localization.median_percent, 1),
          fix_cell(common, common.median_px)};
}

Table table() {
  return Table({"method", "recognition", "precision", "available", "/ceiling", "locked", "/ceiling", "losses",
                "/min", "recover s", "e px", "p95", "% D", "common e"});
}

void print_target(const ScoredComparison& compared, std::size_t t) {
  const StoredComparison& stored = compared.stored;
  Table lines = table();
  std::size_t rows = 0;
  for (std::size_t i = 0; i < stored.runs.size(); ++i) {
    if (!stored.runs[i].trajectory.judged_from[t]) continue;
    lines.add(row(stored.runs[i].record.method, compared.sheets[i].targets[t], compared.common[i][t]));
    ++rows;
  }
  if (rows == 0) return;
  fmt::print("\n  target {}\n{}", stored.recording.targets[t].id, lines.text(2));
}

/// Frames and times of all targets together, of the methods that were asked about every target.
void print_pooled(const ScoredComparison& compared) {
  const StoredComparison& stored = compared.stored;
  Table lines = table();
  for (std::size_t i = 0; i < stored.runs.size(); ++i) {
    const auto& judged = stored.runs[i].trajectory.judged_from;
    if (std::all_of(judged.begin(), judged.end(), [](const auto& from) { return from.has_value(); }))
      lines.add(row(stored.runs[i].record.method, compared.sheets[i].pooled, {}));
  }
  fmt::print("\n  all targets pooled\n{}", lines.text(2));
}

void print_remarks(const ScoredComparison& compared) {
  print_end_of_recording(compared.stored);
  for (std::size_t i = 0; i < compared.stored.runs.size(); ++i) {
    const RunRecord& record = compared.stored.runs[i].record;
    const Scores& s = compared.sheets[i].pooled;
    if (!record.failures.empty())
      fmt::print("  {} failed on frame {}: {}; {} visible frames after it count as Misses\n", record.method,
                 record.failures[0].frame, record.failures[0].what, s.failed);
    if (s.spurious > 0) fmt::print("  {}: {} spurious sightings\n", record.method, s.spurious);
    if (s.uncoded > 0) fmt::print("  {}: {} Hits without a code\n", record.method, s.uncoded);
    if (!record.deterministic)
      fmt::print("  {} answers differently from run to run: its scores are of one run\n", record.method);
  }
}

void store_scores(const ScoredComparison& compared, std::size_t i, const std::string& json) {
  const StoredRun& run = compared.stored.runs[i];
  const Recording& recording = compared.stored.recording;
  std::ostringstream events, verdicts;
  write_events(events, recording, run.trajectory, compared.evaluations[i]);
  write_verdicts(verdicts, recording, compared.evaluations[i]);
  write_file(run.folder / "events.csv", events.str());
  write_file(run.folder / "verdicts.csv", verdicts.str());
  write_file(run.folder / "scores.json", json);
}

}  // namespace

int score(const ScoreArguments& arguments) {
  std::vector<std::string> objects;
  bool first = true;
  auto all = read_results(arguments.folder);
  for (StoredComparison& stored : all) {
    const Gate gate = gate_of(stored, arguments.gate);
    const ScoredComparison compared = scored(std::move(stored), gate);
    for (std::size_t i = 0; i < compared.stored.runs.size(); ++i) {
      objects.push_back(
          scores_json(compared.stored.runs[i], compared.stored.recording, gate, compared.sheets[i]));
      store_scores(compared, i, objects.back());
    }
    if (arguments.json) continue;
    fmt::print("{}{}\n", first ? "" : "\n", heading(compared.stored, gate));
    first = false;
    const std::size_t targets = compared.stored.recording.targets.size();
    for (std::size_t t = 0; t < targets; ++t) print_target(compared, t);
    if (targets > 1) print_pooled(compared);
    print_real_time(compared);
    print_remarks(compared);
  }
  if (arguments.json) {
    fmt::print("{}", json_array(objects));
  } else {
    fmt::print("{}", kFootnote);
  }
  return 0;
}

}  // namespace relock
