#include "cli/runs/folder.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "cli/files.h"
#include "cli/runs/truth.h"
#include "core/csv.h"
#include "core/error.h"
#include "eval/replay/answers_csv.h"
#include "eval/trajectory_csv.h"
#include "sequences/open.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "relock-results.json";

/// "recorded", "recorded-s2", "bernoulli-0.1-s1", "trace-tagslam_test_14_top_left-s1".
std::string gaps_slug(const RunRecord& record) {
  if (record.gaps == "none") return record.seed == 1 ? "recorded" : fmt::format("recorded-s{}", record.seed);
  std::string text = record.gaps;
  if (text.starts_with("trace(")) text = "trace-" + fs::path(text.substr(6, text.size() - 7)).stem().string();
  return fmt::format("{}-s{}", slug(text), record.seed);
}

/// "multistart-0050-backward", "once-latest-constant-20ms".
std::string protocol_slug(const RunRecord& record) {
  std::string text(to_string(record.protocol));
  if (record.anchor)
    text += fmt::format("-{:04}-{}", record.anchor->frame, to_string(record.anchor->direction));
  if (!record.real_time.empty()) text += fmt::format("-{}-{}", slug(record.real_time), slug(record.latency));
  return text;
}

std::string timing_csv(const std::vector<FrameCost>& costs) {
  std::string text = "frame,wall_ms,cpu_ms,peak_mb\n";
  for (const FrameCost& cost : costs)
    text += fmt::format("{},{:.4f},{:.4f},{:.1f}\n", cost.frame, 1e3 * seconds(cost.wall),
                        1e3 * seconds(cost.cpu), 1e-6 * static_cast<double>(cost.peak_bytes));
  return text;
}

/// Whether a file or folder is one that temporary_name() named, of a program that is no more.
bool left_behind(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::size_t tag = name.rfind(".tmp.");
  if (!name.starts_with(".") || tag == std::string::npos) return false;
  const long pid = std::strtol(name.c_str() + tag + 5, nullptr, 10);
  return pid > 0 && (pid == getpid() || ::kill(static_cast<pid_t>(pid), 0) != 0);
}

StoredRun read_run(const fs::path& folder, RunRecord record, const Recording& recording) {
  StoredRun run{folder, std::move(record), {}};
  run.trajectory.method = run.record.method;
  run.trajectory.reads_codes = run.record.reads_codes;
  run.trajectory.judged_from = run.record.judged_from;
  run.trajectory.failed_from = run.record.failed_from;
  const fs::path path = folder / "trajectory.csv";
  std::string rows = read_file(path);
  const bool whole_lines = rows.ends_with('\n');
  std::istringstream text(std::move(rows));
  read_trajectory(text, path.string(), recording, run.trajectory);
  if (!whole_lines || (run.trajectory.frames.size() < recording.frames() && !run.record.cut_short))
    throw Error(fmt::format("{} ends at frame {} of {}; it was cut off: remove its folder and run again",
                            path.string(), run.trajectory.frames.size(), recording.frames()));
  if (!run.record.real_time.empty()) {
    const fs::path answers = folder / "answers.csv";
    std::istringstream answered(read_file(answers));
    run.answers = read_answers(answered, answers.string(), recording);
  }
  return run;
}

void check_conditions(const fs::path& folder, const RunRecord& a, const RunRecord& b) {
  if (a.same_conditions(b)) return;
  throw Error(fmt::format(
      "{} holds runs under other conditions (gaps {}, seed {}{}; not {}, seed {}{}, or the recording "
      "changed); choose another --out or remove it",
      folder.string(), a.gaps, a.seed, a.gate.empty() ? "" : ", gate " + a.gate, b.gaps, b.seed,
      b.gate.empty() ? "" : ", gate " + b.gate));
}

/// Whether a finished run is in this folder: drafts have names that begin with a dot.
bool holds_run(const fs::path& folder) {
  return !folder.filename().string().starts_with(".") && fs::exists(folder / "run.json");
}

std::vector<fs::path> runs_in(const fs::path& comparison) {
  std::vector<fs::path> runs;
  if (!fs::is_directory(comparison)) return runs;
  for (const auto& entry : fs::directory_iterator(comparison))
    if (holds_run(entry.path())) runs.push_back(entry.path());
  return runs;
}

Recording as_played(const Recording& recorded, const std::optional<Anchor>& anchor) {
  return anchor && anchor->direction == Direction::backward ? reflected(recorded) : recorded;
}

/// Throws Error when a run was made from other pictures, times or labels than the truth beside it.
void check_recording(const StoredTruth& truth, const RunRecord& record, const fs::path& folder) {
  if (!truth.fingerprint || *truth.fingerprint == record.fingerprint) return;
  throw Error(
      fmt::format("{} was made from other pictures, times or labels than the truth in {}; run it again",
                  (folder / "run.json").string(), truth.folder.string()));
}

/// Runs that were cut short end where the recording could not be read on: all of them are scored to there.
void end_together(StoredComparison& comparison) {
  comparison.recorded_frames = comparison.recording.frames();
  std::size_t frames = comparison.recorded_frames;
  for (const StoredRun& run : comparison.runs) frames = std::min(frames, run.trajectory.frames.size());
  comparison.recording = up_to(comparison.recording, frames);
  for (StoredRun& run : comparison.runs) run.trajectory.frames.resize(frames);
}

}  // namespace

ResultsLock::ResultsLock(const fs::path& out) {
  const fs::path path = out / ".lock";
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw Error(fmt::format("{} cannot be written ({})", path.string(), std::strerror(errno)));
  // The workers of a program that was killed hold it for a moment longer.
  for (int wait = 0; flock(file_, LOCK_EX | LOCK_NB) != 0; ++wait) {
    if (errno == EWOULDBLOCK && wait < 50) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      continue;
    }
    close(file_);
    if (errno == EWOULDBLOCK)
      throw Error(fmt::format("another relock is writing into {}; wait for it or choose another --out",
                              out.string()));
    throw Error(fmt::format("{} cannot be locked ({})", path.string(), std::strerror(errno)));
  }
}

ResultsLock::~ResultsLock() {
  if (file_ >= 0) close(file_);
}

void remove_left_behind(const fs::path& out) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::recursive_directory_iterator(out))
    if (left_behind(entry.path())) all.push_back(entry.path());
  for (const fs::path& path : all) fs::remove_all(path);
}

ResultsLock prepare_results(const fs::path& out) {
  if (fs::exists(out) && !fs::is_directory(out))
    throw Error(fmt::format("{} is a file; results need a folder", out.string()));
  if (fs::exists(out) && !fs::is_empty(out) && !fs::exists(out / kMarker) && !fs::exists(out / ".lock"))
    throw Error(fmt::format("{} holds files that are not relock's; choose another --out", out.string()));
  make_folder(out);
  ResultsLock lock(out);
  if (!fs::exists(out / kMarker)) write_file(out / kMarker, "{\"format\": 1}\n");
  remove_left_behind(out);
  return lock;
}

fs::path run_folder(const fs::path& out, const RunRecord& record) {
  return out / slug(record.recording) / fmt::format("{}-{}", gaps_slug(record), protocol_slug(record)) /
         slug(record.method);
}

void check_comparison(const fs::path& run_folder, const RunRecord& record) {
  const fs::path comparison = run_folder.parent_path();
  for (const fs::path& run : runs_in(comparison))
    check_conditions(comparison, read_record(run / "run.json"), record);
}

bool already_run(const fs::path& folder, const RunRecord& record) {
  if (!fs::exists(folder / "run.json")) return false;
  const RunRecord there = read_record(folder / "run.json");
  return there.same_inputs(record) && !there.cut_short;
}

void store_run(const fs::path& folder, const FinishedRun& run) {
  const fs::path draft = temporary_name(folder);
  make_folder(draft);
  try {
    write_file(draft / "trajectory.csv", run.trajectory);
    write_file(draft / "timing.csv", timing_csv(run.costs));
    if (!run.record.real_time.empty()) {
      std::ostringstream answers;
      write_answers(answers, run.answers);
      write_file(draft / "answers.csv", answers.str());
    }
    write_file(draft / "run.json", to_json_text(run.record));
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove_all(draft, ignored);
    throw;
  }
  put_in_place(draft, folder);
}

std::vector<FrameCost> read_costs(const fs::path& run_folder) {
  const fs::path path = run_folder / "timing.csv";
  if (!fs::exists(path)) return {};
  std::istringstream text(read_file(path));
  CsvReader rows(text, path.string());
  const auto frame = rows.column("frame"), wall = rows.column("wall_ms"), cpu = rows.column("cpu_ms"),
             peak = rows.column("peak_mb");
  std::vector<FrameCost> costs;
  while (rows.next())
    costs.push_back({rows.whole(frame), from_seconds(1e-3 * rows.number(wall)),
                     from_seconds(1e-3 * rows.number(cpu)), std::llround(1e6 * rows.number(peak))});
  return costs;
}

std::vector<std::vector<FrameCost>> read_costs(const StoredComparison& comparison) {
  std::vector<std::vector<FrameCost>> all;
  for (const StoredRun& run : comparison.runs) all.push_back(read_costs(run.folder));
  return all;
}

std::vector<FoundComparison> find_results(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw Error(fmt::format("{} is no folder of results", folder.string()));
  std::map<fs::path, std::vector<fs::path>> runs_of;  // by comparison
  for (const auto& entry : fs::recursive_directory_iterator(fs::canonical(folder))) {
    const fs::path run = entry.path().parent_path();
    if (entry.path().filename() == "run.json" && holds_run(run)) runs_of[run.parent_path()].push_back(run);
  }
  if (runs_of.empty())
    throw Error(fmt::format("there are no runs below {}; make some with `relock run`", folder.string()));
  std::vector<FoundComparison> all;
  for (auto& [comparison, runs] : runs_of) {
    std::sort(runs.begin(), runs.end());
    all.push_back({comparison, std::move(runs)});
  }
  return all;
}

std::size_t recordings_in(const std::vector<FoundComparison>& found) {
  std::set<std::string> names;  // recordings are folders of comparisons
  for (const FoundComparison& comparison : found)
    names.insert(comparison.folder.parent_path().filename().string());
  return names.size();
}

std::optional<StoredComparison> read_comparison(const FoundComparison& found,
                                                const OnUnreadable& on_unreadable) {
  StoredComparison comparison{found.folder, {}, {}};
  StoredTruth truth;
  try {
    truth = read_stored_truth(found.folder.parent_path());
  } catch (const Error& fault) {
    on_unreadable(fault.what());
    return {};
  }
  for (const fs::path& folder : found.runs) {
    try {
      RunRecord record = read_record(folder / "run.json");
      check_recording(truth, record, folder);
      if (comparison.runs.empty()) {  // all runs of one comparison were played the same way
        comparison.recording = as_played(truth.recording, record.anchor);
      } else {
        check_conditions(found.folder, comparison.runs.front().record, record);
      }
      comparison.runs.push_back(read_run(folder, std::move(record), comparison.recording));
    } catch (const Error& fault) {
      on_unreadable(fault.what());
    }
  }
  if (comparison.runs.empty()) return {};
  std::stable_partition(comparison.runs.begin(), comparison.runs.end(),
                        [](const StoredRun& run) { return !run.record.yardstick; });
  end_together(comparison);
  return comparison;
}

std::vector<StoredComparison> read_results(const fs::path& folder) {
  std::vector<StoredComparison> all;
  for (const FoundComparison& found : find_results(folder))
    all.push_back(*read_comparison(found, [](const std::string& why) { throw Error(why); }));
  return all;
}

}  // namespace relock
