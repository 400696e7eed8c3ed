// `relock run`: shows recordings to methods and writes down what they say.

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core/ocl.hpp>
#include <opencv2/core/utility.hpp>
#include <set>

#include "cli/interrupt.h"
#include "cli/paired.h"
#include "cli/readable.h"
#include "cli/runs/folder.h"
#include "cli/runs/matrix.h"
#include "cli/runs/pool.h"
#include "cli/runs/source.h"
#include "cli/runs/truth.h"
#include "cli/table.h"
#include "cli/terminal.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

constexpr int kMethodFailed = 1, kInputAtFault = 2;

Plan plan_of(const RunArguments& arguments) {
  const bool described = arguments.sequence || arguments.methods || arguments.gaps || arguments.protocol ||
                         arguments.seed || arguments.gate || arguments.labels || arguments.rate_hz ||
                         arguments.format || arguments.topic || arguments.paired || arguments.real_time ||
                         arguments.latency;
  if (arguments.plan && described)
    throw Error("a plan says what to run; beside it only --out, --jobs and --dry-run may be given");
  if (!arguments.plan && !arguments.methods)
    throw Error("say what to run: --methods NAME,..., or a plan file; see `relock run --help`");
  Plan plan;
  if (arguments.plan) {
    plan = read_plan(*arguments.plan);
  } else {
    plan.sequences = {{arguments.sequence.value_or("klahaag"),
                       {arguments.labels, arguments.rate_hz, {}, arguments.format, arguments.topic}}};
    plan.methods = parse_methods(*arguments.methods);
    if (arguments.gaps) plan.gaps = {*arguments.gaps};
    if (arguments.protocol) plan.protocols = {parse_protocol(*arguments.protocol)};
    if (arguments.seed) plan.seeds = {*arguments.seed};
    if (arguments.latency && !arguments.real_time)
      throw Error("--latency needs --real-time latest or queue(n) beside it");
    if (arguments.real_time)
      plan.real_time = parse_real_time(*arguments.real_time, arguments.latency.value_or("measured"));
    if (arguments.gate) plan.gate = parse_gate(*arguments.gate);
    if (arguments.paired) pair_up(plan);
  }
  if (arguments.out) plan.out = *arguments.out;
  if (arguments.frame_limit_s) plan.limits.frame_s = *arguments.frame_limit_s;
  if (arguments.memory_limit_mb) plan.limits.memory_mb = *arguments.memory_limit_mb;
  return plan;
}

/// "klahaag: 53 frames of 640x360, 1.73 s, T 33.333 ms, 24 dropped by paper-6s", and what sets this table
/// apart from the plan's others.
std::string heading(const Plan& plan, const Matrix& matrix, const Condition& condition) {
  const Sequence& sequence = matrix.sequences[condition.sequence];
  const Recording& recording = sequence.recording;
  const Duration period = recording.period, median = sequence.median_interval;
  std::string text =
      fmt::format("{}: {} frames of {}x{}, {:.2f} s, T {:.3f} ms", recording.name, recording.frames(),
                  recording.picture.width, recording.picture.height,
                  seconds(recording.captured.back() - recording.captured.front()), 1e3 * seconds(period));
  if (5 * std::chrono::abs(median - period) > period)  // metrics.md section 2
    text += fmt::format(" (median interval {:.3f} ms)", 1e3 * seconds(median));
  const std::size_t dropped = dropped_frames(condition);
  if (dropped > 0) text += fmt::format(", {} dropped by {}", dropped, condition.gaps);
  if (plan.protocols.size() > 1) text += fmt::format(", protocol {}", to_string(condition.protocol));
  if (plan.seeds.size() > 1) text += fmt::format(", seed {}", condition.seed);
  if (condition.anchor) text += fmt::format(", from {}", to_string(*condition.anchor));
  return text;
}

double seconds_spent(const FinishedRun& run) {
  Duration wall{0};
  for (const FrameCost& cost : run.costs) wall += cost.wall;
  return seconds(wall);
}

/// Prints what came of the runs in the plan's order, each as soon as those before it are told.
class Account {
 public:
  Account(const Plan& plan, const Matrix& matrix)
      : plan_(plan), matrix_(matrix), lines_(matrix.runs.size()) {}

  void add(std::size_t run, std::string line) {
    lines_[run] = std::move(line);
    for (; told_ < lines_.size() && lines_[told_]; ++told_) print(told_);
    std::fflush(stdout);
  }

 private:
  void print(std::size_t run) const {
    const std::size_t condition = matrix_.runs[run].condition;
    if (run == 0 || matrix_.runs[run - 1].condition != condition)
      fmt::print("{}\n", heading(plan_, matrix_, matrix_.conditions[condition]));
    fmt::print("{}  {}\n", padded(matrix_.runs[run].method.text, 12), *lines_[run]);
  }

  const Plan& plan_;
  const Matrix& matrix_;
  std::vector<std::optional<std::string>> lines_;
  std::size_t told_ = 0;
};

/// What went wrong, told on stderr once each when all runs are made.
class Faults {
 public:
  void of_input(const std::string& sentence) { add(sentence, kInputAtFault); }
  void of_method(const std::string& sentence) { add(sentence, kMethodFailed); }
  int tell() const {
    for (const std::string& sentence : sentences_) fmt::print(stderr, "relock: {}\n", sentence);
    return status_;
  }

 private:
  void add(const std::string& sentence, int status) {
    status_ = std::max(status_, status);
    if (std::find(sentences_.begin(), sentences_.end(), sentence) == sentences_.end())
      sentences_.push_back(sentence);
  }
  std::vector<std::string> sentences_;
  int status_ = 0;
};

void note_faults(Faults& faults, const PlannedRun& run, const FinishedRun& done) {
  if (done.record.cut_short)
    faults.of_input(fmt::format("{} (what was seen of the {} frames before it is kept in {})",
                                done.record.cut_short->what, done.record.cut_short->frame,
                                run.folder.parent_path().string()));
  for (const Failure& failure : done.record.failures) {
    std::string tail = failure.output;
    std::replace(tail.begin(), tail.end(), '\n', ' ');
    faults.of_method(fmt::format("{} failed on frame {}: {}{} (it is scored as failed from there on)",
                                 run.method.text, failure.frame, failure.what,
                                 tail.empty() ? "" : fmt::format("; it last wrote \"{}\"", tail)));
    break;  // what comes after the first follows from it
  }
}

/// What the gaps cost, of the runs of this plan only: other runs may be in its folder, too.
int tell_cost(const Plan& plan, const Matrix& matrix) {
  std::set<std::filesystem::path> folders;
  for (const PlannedRun& run : matrix.runs)
    folders.insert(std::filesystem::weakly_canonical(run.folder.parent_path()));
  auto found = find_results(plan.out);
  std::erase_if(found, [&](const FoundComparison& c) { return !folders.contains(c.folder); });
  fmt::print("\n");
  return with_readable(found, [](const std::vector<StoredComparison>& own) { print_cost_of_gaps(own, {}); });
}

int make(const Plan& plan, const Matrix& matrix, int jobs) {
  const ResultsLock lock = prepare_results(plan.out);
  for (std::size_t s = 0; s < matrix.sequences.size(); ++s) {
    const Sequence& sequence = matrix.sequences[s];
    store_truth(plan.out, sequence.recording, sequence.fingerprint);
    store_source(plan.out, sequence.recording.name, plan.sequences[s]);
  }
  std::vector<std::size_t> todo;
  Account account(plan, matrix);
  Faults faults;
  std::size_t complete = 0;
  for (std::size_t run = 0; run < matrix.runs.size(); ++run)
    if (!matrix.runs[run].there) todo.push_back(run);
  for (std::size_t run = 0; run < matrix.runs.size(); ++run)
    if (matrix.runs[run].there) account.add(run, "kept: the same run is there already"), ++complete;
  PoolReport report;
  report.finished = [&](std::size_t run, const FinishedRun& done) {
    account.add(run, fmt::format("{} frames in {:.2f} s", done.costs.size(), seconds_spent(done)));
    note_faults(faults, matrix.runs[run], done);
    ++complete;
  };
  report.not_made = [&](std::size_t run, const std::string& why) {
    account.add(run, "not run");
    faults.of_input(why);
  };
  if (!make_runs(matrix, todo, plan.limits, jobs, report)) {
    faults.tell();
    fmt::print(stderr,
               "relock: interrupted; {} of {} runs are complete and kept, and the same command goes on from "
               "there\n",
               complete, matrix.runs.size());
    return kInterrupted;
  }
  const std::string out = plan.out.string();
  fmt::print("Results are in {0}; see them with `relock timeline {0}` and `relock score {0}`\n", out);
  std::fflush(stdout);
  const int status = plan.paired ? tell_cost(plan, matrix) : 0;
  return std::max(status, faults.tell());
}

/// "multistart from frame 50 backward".
std::string spoken(const Condition& condition) {
  return fmt::format("{}{}", to_string(condition.protocol),
                     condition.anchor ? " from " + to_string(*condition.anchor) : "");
}

/// Lists what would be run, and estimates from a trial of each method on each sequence how long it would
/// take.
int dry_run(const Plan& plan, const Matrix& matrix, int jobs) {
  Table table({"recording", "gaps", "protocol", "seed", "method", "frames", "takes"});
  std::map<std::pair<std::size_t, std::string>, std::optional<double>> pace;  // by sequence and method
  double total = 0;
  std::size_t there = 0, unknown = 0;
  for (const PlannedRun& run : matrix.runs) {
    const Condition& condition = matrix.condition_of(run);
    const std::size_t frames = shown_frames(condition);
    std::string takes = "kept";
    if (run.there) {
      ++there;
    } else {
      const auto key = std::pair(condition.sequence, run.method.text);
      if (!pace.contains(key)) pace[key] = trial_seconds_per_frame(matrix, run);
      const double spent = pace[key].value_or(0) * static_cast<double>(frames);
      total += spent;
      unknown += pace[key] ? 0 : 1;
      takes = pace[key] ? spoken_time(spent) : "unknown";
    }
    table.add({matrix.sequence_of(run).recording.name, condition.gaps, spoken(condition),
               fmt::format("{}", condition.seed), run.method.text, fmt::format("{}", frames), takes});
  }
  fmt::print("{}", table.text(0));
  for (const std::string& why : matrix.left_out) fmt::print("left out: {}\n", why);
  fmt::print(
      "{} runs to {}, {} of them there already; the others take about {} with --jobs {}, by a trial of "
      "ten frames each{}\n",
      matrix.runs.size(), plan.out.string(), there, spoken_time(total / jobs), jobs,
      unknown == 0 ? "" : fmt::format(" ({} runs failed their trial)", unknown));
  return 0;
}

}  // namespace

int run(const RunArguments& arguments, const Methods& methods) {
  cv::setNumThreads(1);  // the same bytes and comparable times on any machine
  cv::ocl::setUseOpenCL(false);
  const Plan plan = plan_of(arguments);
  const Matrix matrix = multiply_out(plan, methods);
  if (arguments.dry_run) return dry_run(plan, matrix, arguments.jobs);
  for (const std::string& why : matrix.left_out) fmt::print("left out: {}\n", why);
  return make(plan, matrix, arguments.jobs);
}

}  // namespace relock
