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
#include <sstream>
#include <thread>

#include "cli/files.h"
#include "core/csv.h"
#include "core/error.h"
#include "eval/replay/answers_csv.h"
#include "eval/trajectory_csv.h"
#include "sequences/open.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "relock-results.json";

/// A name that any file system takes: whatever is not a letter, a digit, '.', '_' or '-' becomes '-'.
std::string slug(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-';
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() || name.front() == '.' ? "_" + name : name;
}

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

void make_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", folder.string(), fault.message()));
}

/// Puts a finished folder in its place. An older one is moved away first, whole, and then removed: whoever is
/// killed in between leaves nothing that is half there.
void put_in_place(const fs::path& finished, const fs::path& place) {
  const fs::path old = temporary_name(place.string() + ".old");
  if (fs::exists(place)) fs::rename(place, old);
  fs::rename(finished, place);
  fs::remove_all(old);
}

/// Whether a file or folder is one that temporary_name() named, of a program that is no more.
bool left_behind(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::size_t tag = name.rfind(".tmp.");
  if (!name.starts_with(".") || tag == std::string::npos) return false;
  const long pid = std::strtol(name.c_str() + tag + 5, nullptr, 10);
  return pid > 0 && (pid == getpid() || ::kill(static_cast<pid_t>(pid), 0) != 0);
}

void remove_left_behind(const fs::path& out) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::recursive_directory_iterator(out))
    if (left_behind(entry.path())) all.push_back(entry.path());
  for (const fs::path& path : all) fs::remove_all(path);
}

StoredRun read_run(const fs::path& folder, const Recording& recording) {
  StoredRun run{folder, read_record(folder / "run.json"), {}};
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

/// The recordings/ folder that belongs to a comparison.
fs::path truth_folder(const fs::path& comparison) { return comparison.parent_path() / "recording"; }

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

fs::path truth_place(const fs::path& out, const Recording& recording) {
  return out / slug(recording.name) / "recording";
}

constexpr const char* kTruthFiles[] = {"recording.toml", "timestamps.csv", "labels.csv"};

/// One line for each file of the truth: what it was when runs were made.
void store_checksums(const fs::path& truth) {
  std::string text;
  for (const char* file : kTruthFiles) text += fmt::format("{} {}\n", file, file_fingerprint(truth / file));
  write_file(truth / "checksums", text);
}

/// Throws Error when a file of the truth is not what it was: scores would be of something that no method saw.
void check_checksums(const fs::path& truth) {
  if (!fs::exists(truth / "checksums")) return;
  const std::string stored = read_file(truth / "checksums");
  for (const char* file : kTruthFiles)
    if (stored.find(fmt::format("{} {}\n", file, file_fingerprint(truth / file))) == std::string::npos)
      throw Error(
          fmt::format("{} was changed after the runs beside it were made; change it where the recording is "
                      "and run again",
                      (truth / file).string()));
}

std::vector<fs::path> runs_in(const fs::path& comparison) {
  std::vector<fs::path> runs;
  if (!fs::is_directory(comparison)) return runs;
  for (const auto& entry : fs::directory_iterator(comparison))
    if (holds_run(entry.path())) runs.push_back(entry.path());
  return runs;
}

/// Runs of one comparison were all played the same way. One that cannot be read is told of later.
Recording as_played(Recording recorded, const std::vector<fs::path>& run_folders) {
  for (const fs::path& run : run_folders) {
    try {
      const auto anchor = read_record(run / "run.json").anchor;
      return anchor && anchor->direction == Direction::backward ? reflected(recorded) : std::move(recorded);
    } catch (const Error&) {
    }
  }
  return recorded;
}

/// Throws Error when a run was made from other pictures, times or labels than the truth beside it.
void check_recording(const StoredRun& run, const fs::path& truth) {
  const fs::path file = truth / "fingerprint";
  if (!fs::exists(file) || read_file(file) == run.record.fingerprint + "\n") return;
  throw Error(
      fmt::format("{} was made from other pictures, times or labels than the truth in {}; run it again",
                  (run.folder / "run.json").string(), truth.string()));
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

void check_truth(const fs::path& out, const Recording& recording, const std::string& fingerprint) {
  const fs::path place = truth_place(out, recording);
  if (!fs::exists(place) || read_file(place / "fingerprint") == fingerprint + "\n") return;
  throw Error(
      fmt::format("{} was made from other pictures, times or labels than {} has now; choose another "
                  "--out or remove it",
                  place.parent_path().string(), recording.name));
}

void store_truth(const fs::path& out, const Recording& recording, const std::string& fingerprint) {
  check_truth(out, recording, fingerprint);
  const fs::path place = truth_place(out, recording);
  if (fs::exists(place)) return;
  const fs::path draft = temporary_name(place);
  make_folder(draft);
  write_truth(draft, recording);
  store_checksums(draft);
  write_file(draft / "fingerprint", fingerprint + "\n");
  put_in_place(draft, place);
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

std::optional<StoredComparison> read_comparison(const FoundComparison& found,
                                                const OnUnreadable& on_unreadable) {
  const fs::path truth = truth_folder(found.folder);
  StoredComparison comparison{found.folder, {}, {}};
  try {
    if (!fs::exists(truth))
      throw Error(
          fmt::format("{} is missing: runs cannot be scored without the truth beside them", truth.string()));
    comparison.recording = as_played(read_truth(truth), found.runs);
    check_checksums(truth);
  } catch (const Error& fault) {
    on_unreadable(fault.what());
    return {};
  }
  for (const fs::path& folder : found.runs) {
    try {
      StoredRun run = read_run(folder, comparison.recording);
      check_recording(run, truth);
      if (!comparison.runs.empty())
        check_conditions(found.folder, comparison.runs.front().record, run.record);
      comparison.runs.push_back(std::move(run));
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
