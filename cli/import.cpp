// `relock import`: make a run of result files that another toolkit wrote.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/benchmark_files.h"
#include "cli/catalogue.h"
#include "cli/recordings.h"
#include "cli/runs/folder.h"
#include "cli/runs/source.h"
#include "cli/runs/truth.h"
#include "cli/verbs.h"
#include "cli/version.h"
#include "core/error.h"
#include "core/nearest.h"
#include "eval/trajectory_csv.h"
#include "sequences/open.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

/// The targets that the files are of, one each.
std::vector<std::size_t> targets_of(const ImportArguments& arguments, const Recording& recording) {
  std::vector<std::string> ids, wanted = arguments.targets;
  for (const Target& target : recording.targets) ids.push_back(target.id);
  if (wanted.empty()) wanted = ids;
  if (wanted.size() != arguments.files.size())
    throw Error(fmt::format("{} files cannot be of the {} targets {}; name theirs with --target",
                            arguments.files.size(), wanted.size(), fmt::join(wanted, ", ")));
  std::vector<std::size_t> targets;
  for (const std::string& id : wanted) {
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found == ids.end())
      throw Error(fmt::format("{} has no target \"{}\"{}", recording.name, id, did_you_mean(id, ids)));
    targets.push_back(static_cast<std::size_t>(found - ids.begin()));
    if (std::count(targets.begin(), targets.end(), targets.back()) > 1)
      throw Error(fmt::format("target {} is named twice", id));
  }
  return targets;
}

bool known(const Recording& recording, std::size_t frame, std::size_t target) {
  return recording.truth_of(frame, target).outline.has_value();
}

/// The frame that the first line is of: results have a line for each picture, or, where labels begin later,
/// one for each from there on.
std::size_t first_frame(const fs::path& file, std::size_t lines, const Recording& recording,
                        std::size_t target) {
  std::size_t labelled = 0;
  while (labelled < recording.frames() && !known(recording, labelled, target)) ++labelled;
  if (lines == recording.frames()) return 0;
  if (labelled < recording.frames() && lines == recording.frames() - labelled) return labelled;
  throw Error(
      fmt::format("{}: there are {} lines for the {} pictures of {}; are these results of another "
                  "recording?",
                  file.string(), lines, recording.frames(), recording.name));
}

/// Adds what one file says to the trajectory. Frames between a failure and the next start, or the end, are
/// withheld, as protocol vot withholds them: the toolkit did not ask.
void add_answers(const fs::path& file, ResultFormat format, const Recording& recording, std::size_t target,
                 Trajectory& trajectory) {
  std::vector<ForeignAnswer> answers = read_answers(format, file);
  const std::size_t first = first_frame(file, answers.size(), recording, target);
  auto& from = trajectory.judged_from[target];
  bool failed = false;  // and not started again
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::size_t frame = first + i;
    FrameReport& report = trajectory.frames[frame];
    ForeignAnswer& answer = answers[i];
    // One-pass files do not say that the tracker was started: it was, where the truth begins.
    if (format != ResultFormat::vot && !from && known(recording, frame, target)) answer.code = VotCode::start;
    if (answer.code == VotCode::start) {
      if (!known(recording, frame, target))
        throw Error::at(file.string(), i + 1,
                        fmt::format("the tracker is started here, but the labels of {} do not say where the "
                                    "target is",
                                    recording.name));
      report.given.push_back(target);
      if (!from) from = static_cast<FrameIndex>(frame);
      failed = false;
    } else if (failed) {
      if (answer.outline)
        throw Error::at(file.string(), i + 1,
                        "a region between a failure (2) and the next start (1); only 0 can be there");
      report.withheld.push_back(target);
    } else if (from && answer.outline) {
      Sighting sighting = sighting_of(*answer.outline);
      sighting.track = recording.targets[target].id;
      report.sightings.push_back(as_stored(std::move(sighting)));
    }
    failed |= from && answer.code == VotCode::failure;
  }
  if (!from) throw Error(fmt::format("{}: the tracker is never started", file.string()));
}

RunRecord record_of(const ImportArguments& arguments, ResultFormat format, const Sequence& sequence,
                    const Trajectory& trajectory) {
  RunRecord record;
  record.relock_version = kVersion;
  record.program = "imported";
  for (const fs::path& file : arguments.files) record.program += " " + file_fingerprint(file);
  record.recording = sequence.recording.name;
  record.fingerprint = sequence.fingerprint;
  record.method = arguments.method;
  record.options = {{"imported_as", std::string(to_string(format))}};
  record.gaps = "none";
  record.protocol = parse_protocol(format == ResultFormat::vot ? "vot" : "once");
  record.judged_from = trajectory.judged_from;
  record.failed_from = trajectory.failed_from;
  return record;
}

std::string text_of(const Recording& recording, const Trajectory& trajectory) {
  std::string text = trajectory_header();
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i) append_report(text, recording, trajectory, i);
  return text;
}

/// Yardsticks are computed, and every comparison has its own: no file can stand for one. The folder's name is what
/// runs are told apart by.
void check_name(const std::string& method, const fs::path& folder) {
  if (is_yardstick(method) || is_yardstick(folder.filename().string()))
    throw Error(
        fmt::format("{} is a yardstick, which relock computes itself; choose another --method", method));
}

/// An imported run may be imported again; one that relock measured is not replaced by a file.
void check_not_replaced(const fs::path& folder) {
  const fs::path record = folder / "run.json";
  if (fs::exists(record) && !read_record(record).imported())
    throw Error(
        fmt::format("{} holds a run that was made here, not imported; choose another --out or --method",
                    folder.string()));
}

}  // namespace

int import_results(const ImportArguments& arguments) {
  const ResultFormat format = parse_result_format(arguments.as);
  const Sequence sequence = open_sequence(recording_path(arguments.sequence),
                                          {arguments.labels, arguments.rate_hz, {}, arguments.format, {}});
  const Recording& recording = sequence.recording;
  Trajectory trajectory;
  trajectory.frames.resize(recording.frames());
  trajectory.judged_from.resize(recording.targets.size());
  trajectory.failed_from.resize(recording.targets.size());
  const auto targets = targets_of(arguments, recording);
  for (std::size_t i = 0; i < targets.size(); ++i)
    add_answers(arguments.files[i], format, recording, targets[i], trajectory);
  for (FrameReport& report : trajectory.frames) {
    std::sort(report.given.begin(), report.given.end());
    std::sort(report.withheld.begin(), report.withheld.end());
  }

  const RunRecord record = record_of(arguments, format, sequence, trajectory);
  const fs::path folder = run_folder(arguments.out, record);
  check_name(arguments.method, folder);
  const ResultsLock lock = prepare_results(arguments.out);
  store_truth(arguments.out, recording, sequence.fingerprint);
  store_source(arguments.out, recording.name,
               {arguments.sequence, {arguments.labels, arguments.rate_hz, {}, arguments.format}});
  check_comparison(folder, record);
  check_not_replaced(folder);
  store_run(folder, {record, text_of(recording, trajectory), {}});
  const std::string out = arguments.out.string();
  fmt::print("{0} on {1} is in {2}; see it with `relock timeline {2}` and `relock score {2}`\n",
             arguments.method, recording.name, out);
  return 0;
}

}  // namespace relock
