#include "cli/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "eval/trajectory_csv.h"
#include "sequences/open.h"

namespace relock {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kMarker = "relock-results.json";

Json to_json(const std::vector<std::optional<FrameIndex>>& frames) {
  Json all = Json::array();
  for (const auto& frame : frames) all.push_back(frame ? Json(*frame) : Json());
  return all;
}

Json to_json(const Failure& failure) { return {{"frame", failure.frame}, {"what", failure.what}}; }

Json inputs_json(const RunRecord& r) {
  return {{"relock", r.relock_version},
          {"opencv", r.opencv_version},
          {"recording", r.recording},
          {"fingerprint", r.fingerprint},
          {"method", r.method},
          {"options", r.options},
          {"gaps", r.gaps},
          {"dropped", r.dropped},
          {"seed", r.seed},
          {"protocol", to_string(r.protocol)},
          {"gate", r.gate.empty() ? Json() : Json(r.gate)}};
}

Json to_json(const RunRecord& r) {
  Json failures = Json::array();
  for (const Failure& failure : r.failures) failures.push_back(to_json(failure));
  return {{"format", 1},
          {"inputs", inputs_json(r)},
          {"yardstick", r.yardstick},
          {"reads_codes", r.reads_codes},
          {"deterministic", r.deterministic},
          {"judged_from", to_json(r.judged_from)},
          {"failed_from", to_json(r.failed_from)},
          {"failures", failures},
          {"cut_short", r.cut_short ? to_json(*r.cut_short) : Json()}};
}

std::vector<std::optional<FrameIndex>> frames_from(const Json& json) {
  std::vector<std::optional<FrameIndex>> all;
  for (const Json& frame : json)
    all.push_back(frame.is_null() ? std::nullopt : std::optional(frame.get<FrameIndex>()));
  return all;
}

Failure failure_from(const Json& json) {
  return {json.at("frame").get<FrameIndex>(), json.at("what").get<std::string>()};
}

RunRecord record_from(const Json& json) {
  RunRecord r;
  const Json& inputs = json.at("inputs");
  r.relock_version = inputs.at("relock");
  r.opencv_version = inputs.at("opencv");
  r.recording = inputs.at("recording");
  r.fingerprint = inputs.at("fingerprint");
  r.method = inputs.at("method");
  r.options = inputs.at("options").get<std::map<std::string, std::string>>();
  r.gaps = inputs.at("gaps");
  r.dropped = inputs.at("dropped").get<std::vector<FrameIndex>>();
  r.seed = inputs.at("seed");
  r.protocol = parse_protocol(inputs.at("protocol").get<std::string>());
  if (!inputs.at("gate").is_null()) r.gate = inputs.at("gate");
  r.yardstick = json.at("yardstick");
  r.reads_codes = json.at("reads_codes");
  r.deterministic = json.at("deterministic");
  r.judged_from = frames_from(json.at("judged_from"));
  r.failed_from = frames_from(json.at("failed_from"));
  for (const Json& failure : json.at("failures")) r.failures.push_back(failure_from(failure));
  if (!json.at("cut_short").is_null()) r.cut_short = failure_from(json.at("cut_short"));
  return r;
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(fmt::format("{} cannot be read", path.string()));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

RunRecord read_record(const fs::path& path) {
  try {
    return record_from(Json::parse(read_file(path)));
  } catch (const std::exception& fault) {
    throw Error(fmt::format("{} is no run.json of this relock ({}); remove its folder and run again",
                            path.string(), fault.what()));
  }
}

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

/// "recorded", "bernoulli-0.1-s1", "trace-tagslam_test_14_top_left-s1".
std::string gaps_slug(const RunRecord& record) {
  if (record.gaps == "none") return "recorded";
  std::string text = record.gaps;
  if (text.starts_with("trace(")) text = "trace-" + fs::path(text.substr(6, text.size() - 7)).stem().string();
  return fmt::format("{}-s{}", slug(text), record.seed);
}

std::string timing_csv(const std::vector<FrameCost>& costs) {
  std::string text = "frame,wall_ms,cpu_ms\n";
  for (const FrameCost& cost : costs)
    text += fmt::format("{},{:.4f},{:.4f}\n", cost.frame, 1e3 * seconds(cost.wall), 1e3 * seconds(cost.cpu));
  return text;
}

fs::path temporary_name(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.tmp.{}", path.filename().string(), getpid());
}

void make_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", folder.string(), fault.message()));
}

/// Puts a finished folder in its place, and an older one out of it.
void put_in_place(const fs::path& finished, const fs::path& place) {
  fs::remove_all(place);
  fs::rename(finished, place);
}

/// The recording as far as a run that was cut short saw it.
Recording up_to(const Recording& recording, std::size_t frames) {
  Recording part = recording;
  part.captured.resize(frames);
  part.truth.resize(frames * recording.targets.size());
  return part;
}

StoredRun read_run(const fs::path& folder, const Recording& recording) {
  StoredRun run{folder, read_record(folder / "run.json"), {}};
  run.trajectory.reads_codes = run.record.reads_codes;
  run.trajectory.judged_from = run.record.judged_from;
  run.trajectory.failed_from = run.record.failed_from;
  const fs::path path = folder / "trajectory.csv";
  std::istringstream text(read_file(path));
  read_trajectory(text, path.string(), recording, run.trajectory);
  if (run.trajectory.frames.size() < recording.frames() && !run.record.cut_short)
    throw Error(fmt::format("{} ends at frame {} of {}; it was cut off: remove its folder and run again",
                            path.string(), run.trajectory.frames.size(), recording.frames()));
  return run;
}

/// The recordings/ folder that belongs to a comparison.
fs::path truth_folder(const fs::path& comparison) { return comparison.parent_path() / "recording"; }

/// What must be the same for runs to stand in one table: the inputs but the method and the program.
Json conditions(const RunRecord& record) {
  Json inputs = inputs_json(record);
  for (const char* own : {"relock", "opencv", "method", "options"}) inputs.erase(own);
  return inputs;
}

void check_conditions(const fs::path& folder, const RunRecord& a, const RunRecord& b) {
  if (conditions(a) == conditions(b)) return;
  throw Error(fmt::format(
      "{} holds runs under other conditions (gaps {}, seed {}{}; not {}, seed {}{}, or the recording "
      "changed); choose another --out or remove it",
      folder.string(), a.gaps, a.seed, a.gate.empty() ? "" : ", gate " + a.gate, b.gaps, b.seed,
      b.gate.empty() ? "" : ", gate " + b.gate));
}

std::vector<fs::path> runs_in(const fs::path& comparison) {
  std::vector<fs::path> runs;
  if (!fs::is_directory(comparison)) return runs;
  for (const auto& entry : fs::directory_iterator(comparison)) {
    const bool draft = entry.path().filename().string().starts_with(".");
    if (!draft && fs::exists(entry.path() / "run.json")) runs.push_back(entry.path());
  }
  return runs;
}

StoredComparison read_comparison(const fs::path& folder, std::vector<fs::path> run_folders) {
  const fs::path truth = truth_folder(folder);
  if (!fs::exists(truth))
    throw Error(
        fmt::format("{} is missing: runs cannot be scored without the truth beside them", truth.string()));
  StoredComparison comparison{folder, read_truth(truth), {}};
  std::sort(run_folders.begin(), run_folders.end());
  for (const fs::path& run : run_folders) comparison.runs.push_back(read_run(run, comparison.recording));
  for (const StoredRun& run : comparison.runs)
    check_conditions(folder, comparison.runs.front().record, run.record);
  std::stable_partition(comparison.runs.begin(), comparison.runs.end(),
                        [](const StoredRun& run) { return !run.record.yardstick; });
  // Runs that were cut short end where the recording could not be read on: all of them are scored to there.
  std::size_t frames = comparison.recording.frames();
  for (const StoredRun& run : comparison.runs) frames = std::min(frames, run.trajectory.frames.size());
  comparison.recording = up_to(comparison.recording, frames);
  for (StoredRun& run : comparison.runs) run.trajectory.frames.resize(frames);
  return comparison;
}

}  // namespace

bool RunRecord::same_inputs(const RunRecord& other) const { return inputs_json(*this) == inputs_json(other); }

void prepare_results(const fs::path& out) {
  if (fs::exists(out) && !fs::is_directory(out))
    throw Error(fmt::format("{} is a file; results need a folder", out.string()));
  if (fs::exists(out) && !fs::is_empty(out) && !fs::exists(out / kMarker))
    throw Error(fmt::format("{} holds files that are not relock's; choose another --out", out.string()));
  make_folder(out);
  write_file(out / kMarker, "{\"format\": 1}\n");
}

void store_truth(const fs::path& out, const Recording& recording, const std::string& fingerprint) {
  const fs::path place = out / slug(recording.name) / "recording";
  if (fs::exists(place)) {
    if (read_file(place / "fingerprint") == fingerprint + "\n") return;
    throw Error(
        fmt::format("{} was made from other pictures, times or labels than {} has now; choose another "
                    "--out or remove it",
                    place.parent_path().string(), recording.name));
  }
  const fs::path draft = temporary_name(place);
  make_folder(draft);
  write_truth(draft, recording);
  write_file(draft / "fingerprint", fingerprint + "\n");
  put_in_place(draft, place);
}

fs::path run_folder(const fs::path& out, const RunRecord& record) {
  return out / slug(record.recording) / fmt::format("{}-{}", gaps_slug(record), to_string(record.protocol)) /
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

void store_run(const fs::path& folder, const RunRecord& record, const Recording& recording,
               const Replay& replay) {
  const fs::path draft = temporary_name(folder);
  make_folder(draft);
  std::ostringstream trajectory;
  write_trajectory(trajectory, recording, replay.trajectory);
  write_file(draft / "trajectory.csv", trajectory.str());
  write_file(draft / "timing.csv", timing_csv(replay.costs));
  write_file(draft / "run.json", to_json(record).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  put_in_place(draft, folder);
}

std::vector<StoredComparison> read_results(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw Error(fmt::format("{} is no folder of results", folder.string()));
  std::map<fs::path, std::vector<fs::path>> runs_of;  // by comparison
  for (const auto& entry : fs::recursive_directory_iterator(fs::canonical(folder))) {
    const fs::path run = entry.path().parent_path();
    const bool draft = run.filename().string().starts_with(".");
    if (entry.path().filename() == "run.json" && !draft) runs_of[run.parent_path()].push_back(run);
  }
  if (runs_of.empty())
    throw Error(fmt::format("there are no runs below {}; make some with `relock run`", folder.string()));
  std::vector<StoredComparison> all;
  for (auto& [comparison, runs] : runs_of) all.push_back(read_comparison(comparison, std::move(runs)));
  return all;
}

void write_file(const fs::path& path, const std::string& content) {
  const fs::path draft = temporary_name(path);
  std::ofstream out(draft, std::ios::binary);
  out << content;
  out.close();
  std::error_code fault;
  if (out) fs::rename(draft, path, fault);
  if (!out || fault) {
    std::error_code ignored;
    fs::remove(draft, ignored);
    throw Error(
        fmt::format("{} cannot be written; is the disk full, or the folder another user's?", path.string()));
  }
}

}  // namespace relock
