#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/runs/record.h"
#include "core/recording.h"
#include "eval/replay/replay.h"

namespace relock {

// Where results are:
//   OUT/relock-results.json                       says that the folder is relock's
//   OUT/.lock                                     held by the program that writes here
//   OUT/RECORDING/recording/                      truth: recording.toml, timestamps.csv, labels.csv, and how to tell
//                                                 whether they or the recording changed: fingerprint, checksums
//   OUT/RECORDING/GAPS-PROTOCOL/METHOD/           one run: run.json, trajectory.csv, timing.csv,
//                                                 answers.csv (real time);
//                                                 `relock score` adds scores.json, events.csv, verdicts.csv
// A run folder is written under a temporary name and renamed when it is complete.

/// A run read back from its folder.
struct StoredRun {
  std::filesystem::path folder;
  RunRecord record;
  Trajectory trajectory;
  std::vector<Answer> answers = {};  ///< real time
};
/// All runs on one recording with the same gaps and protocol: what may stand in one table.
struct StoredComparison {
  std::filesystem::path folder;
  Recording recording;              ///< as it was played
  std::vector<StoredRun> runs;      ///< by name; yardsticks last
  std::size_t recorded_frames = 0;  ///< of the whole recording, where runs that were cut short end before
};

/// Keeps other programs from writing into a results folder, for as long as it lives.
class ResultsLock {
 public:
  /// Waits a little for another program; throws Error when it goes on.
  explicit ResultsLock(const std::filesystem::path& out);
  ~ResultsLock();
  ResultsLock(ResultsLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  ResultsLock& operator=(ResultsLock&&) = delete;

 private:
  int file_ = -1;
};

/// Removes what programs that were killed left half written in `out` and below.
void remove_left_behind(const std::filesystem::path& out);

/// Makes `out` ready and locks it: creates it, or checks that it is relock's, and removes what a program that
/// was killed left half done. Throws Error when it belongs to something else or cannot be written.
ResultsLock prepare_results(const std::filesystem::path& out);

/// Where a run belongs.
std::filesystem::path run_folder(const std::filesystem::path& out, const RunRecord& record);
/// Throws Error when the runs beside it were made under other conditions: other gaps, seed or gate.
void check_comparison(const std::filesystem::path& run_folder, const RunRecord& record);
/// Whether a complete run with the same inputs is there already.
bool already_run(const std::filesystem::path& folder, const RunRecord& record);

/// A run as it will be on disk.
struct FinishedRun {
  RunRecord record;
  std::string trajectory;  ///< trajectory.csv
  std::vector<FrameCost> costs;
  std::vector<Answer> answers = {};  ///< real time: answers.csv
};
/// Writes a run, in the place of an older one: whole or not at all.
void store_run(const std::filesystem::path& folder, const FinishedRun& run);

/// What a run cost, frame by frame: its timing.csv; nothing where it has none. Throws Error with file and line.
std::vector<FrameCost> read_costs(const std::filesystem::path& run_folder);

/// Of each run of a comparison.
std::vector<std::vector<FrameCost>> read_costs(const StoredComparison& comparison);

/// The runs of a comparison, found and not read yet.
struct FoundComparison {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> runs;  ///< their folders, by name
};
/// Finds all runs below `folder`: a results folder or a part of one. Throws Error when there is none.
std::vector<FoundComparison> find_results(const std::filesystem::path& folder);
/// Of how many recordings.
std::size_t recordings_in(const std::vector<FoundComparison>& found);

/// Is told, in a sentence with file and line, of a run that is left out because it cannot be read.
using OnUnreadable = std::function<void(const std::string& why)>;
/// Reads runs and the truth beside them. Nothing when there is no truth, or no run of it can be read.
std::optional<StoredComparison> read_comparison(const FoundComparison& found,
                                                const OnUnreadable& on_unreadable);

/// Finds and reads all runs below `folder`. Throws Error when there is none, or one cannot be read.
std::vector<StoredComparison> read_results(const std::filesystem::path& folder);

}  // namespace relock
