// `relock export`: write runs as the result files of other toolkits.

#include <fmt/format.h>

#include <set>

#include "cli/benchmark_files.h"
#include "cli/files.h"
#include "cli/readable.h"
#include "cli/runs/folder.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

/// Seconds that each frame took, one a line; 0 where the method was not asked.
std::string times_text(const std::vector<FrameCost>& costs, std::size_t frames) {
  std::vector<Duration> walls(frames, Duration(0));
  for (const FrameCost& cost : costs)
    if (const auto i = static_cast<std::size_t>(cost.frame); i < frames) walls[i] = cost.wall;
  std::string text;
  for (const Duration wall : walls) text += fmt::format("{:.8f}\n", seconds(wall));
  return text;
}

/// Writes files below a folder, none twice.
class Files {
 public:
  explicit Files(fs::path out) : out_(std::move(out)) {
    if (fs::exists(out_) && (!fs::is_directory(out_) || !fs::is_empty(out_)))
      throw Error(fmt::format("{} is there already; choose another --out or remove it", out_.string()));
  }
  void write(const fs::path& path, const std::string& text) {
    if (!written_.insert(path).second)
      throw Error(
          fmt::format("two runs belong in {}, of other gaps, seeds or protocols; export a part of the "
                      "results, such as RESULTS/RECORDING/recorded-once",
                      (out_ / path).string()));
    fs::create_directories((out_ / path).parent_path());
    write_file(out_ / path, text);
  }
  std::size_t count() const { return written_.size(); }
  bool has(const fs::path& path) const { return written_.contains(path); }

 private:
  fs::path out_;
  std::set<fs::path> written_;
};

void write_run(const StoredComparison& comparison, const StoredRun& run, ResultFormat format, Files& files) {
  const Recording& recording = comparison.recording;
  const std::string method = run.folder.filename().string();
  for (std::size_t t = 0; t < recording.targets.size(); ++t) {
    const auto sequence = answers_for(recording, run.trajectory, t);
    if (!sequence) continue;
    files.write(result_path(format, method, sequence->name), result_text(format, *sequence, recording));
    if (const auto times = times_path(format, method, sequence->name))
      files.write(*times, times_text(read_costs(run.folder), recording.frames()));
    const fs::path truth = result_path(format, "truth", sequence->name);
    if (format == ResultFormat::tum && !files.has(truth)) files.write(truth, tum_truth(*sequence, recording));
  }
}

/// Writes whatever the format is for, and tells what it is not for.
void write_all(const std::vector<StoredComparison>& all, const ExportArguments& arguments,
               ResultFormat format, Files& files) {
  for (const StoredComparison& comparison : all) {
    const Protocol protocol = comparison.runs.front().record.protocol;
    if (!fits(format, protocol)) {
      fmt::print("left out: {}, protocol {} is not what {} scores\n", comparison.folder.string(),
                 to_string(protocol), arguments.as);
      continue;
    }
    for (const StoredRun& run : comparison.runs) write_run(comparison, run, format, files);
  }
  if (files.count() == 0)
    throw Error(fmt::format("no run below {} can be written as {}: it is for runs of protocol {}",
                            arguments.folder.string(), arguments.as,
                            format == ResultFormat::vot ? "vot" : "once or detect"));
  fmt::print("{} files in {}\n", files.count(), arguments.out.string());
}

}  // namespace

int export_results(const ExportArguments& arguments) {
  const ResultFormat format = parse_result_format(arguments.as);
  return with_readable(find_results(arguments.folder), [&](const std::vector<StoredComparison>& all) {
    Files files(arguments.out);
    write_all(all, arguments, format, files);
  });
}

}  // namespace relock
