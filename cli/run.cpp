// `relock run`: shows a recording to each method in turn and writes down what it says.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/version.hpp>

#include "cli/catalogue.h"
#include "cli/recording_path.h"
#include "cli/run_folder.h"
#include "cli/terminal.h"
#include "cli/verbs.h"
#include "cli/version.h"
#include "core/error.h"
#include "eval/replay.h"
#include "sequences/gaps.h"
#include "sequences/open.h"

namespace relock {
namespace {

/// Everything that the runs of one call have in common.
struct Plan {
  Sequence sequence;
  GapPattern gaps;
  Schedule schedule;
  Protocol protocol;
  Gate gate;
  std::uint64_t seed;
  std::filesystem::path out;
  std::string program;  // its fingerprint
};

std::vector<ChosenMethod> chosen_methods(const RunArguments& arguments, const Methods& methods,
                                         Protocol protocol) {
  std::vector<ChosenMethod> chosen;
  for (const MethodSpec& spec : parse_methods(arguments.methods)) chosen.push_back(choose(methods, spec));
  const bool with_start = protocol != Protocol::detect;
  for (const ChosenMethod& method : chosen)
    if (method.needs_start && !with_start)
      throw Error(fmt::format(
          "{} needs a box to start from, and protocol detect gives none; use once or reset", method.text));
  for (ChosenMethod& yardstick : yardsticks(methods, with_start, chosen))
    chosen.push_back(std::move(yardstick));
  return chosen;
}

/// Frames that no pattern may take: where methods are started.
std::vector<FrameIndex> start_frames(const Recording& recording) {
  std::vector<FrameIndex> frames;
  for (const auto& start : first_startable(recording))
    if (start) frames.push_back(*start);
  return frames;
}

void check_labels(const Sequence& sequence, const RunArguments& arguments) {
  const Recording& recording = sequence.recording;
  if (recording.targets.empty())
    throw Error(
        fmt::format("{} has no labels.csv, and without truth nothing can be scored; give --labels FILE",
                    arguments.sequence.string()));
  for (const TargetTruth& truth : recording.truth)
    if (truth.label == Label::visible) return;
  throw Error(fmt::format("no target of {} is ever visible, so there is nothing to score", recording.name));
}

std::vector<bool> asked(const ChosenMethod& method, const Recording& recording) {
  std::vector<bool> all;
  for (const Target& target : recording.targets) all.push_back(method.asked_about(target));
  if (std::find(all.begin(), all.end(), true) == all.end())
    throw Error(
        fmt::format("{} reads codes of {}, and no target of {} has one; give the target's code in "
                    "recording.toml",
                    method.text, fmt::join(method.reads, ", "), recording.name));
  return all;
}

RunRecord record_of(const Plan& plan, const ChosenMethod& method) {
  RunRecord record;
  record.relock_version = kVersion;
  record.program = plan.program;
  record.opencv_version = CV_VERSION;
  record.recording = plan.sequence.recording.name;
  record.fingerprint = plan.sequence.fingerprint;
  record.method = method.text;
  record.options = method.options;
  record.gaps = plan.gaps.text();
  for (std::size_t frame = 0; frame < plan.schedule.frames(); ++frame)
    if (!plan.schedule.delivered(frame)) record.dropped.push_back(static_cast<FrameIndex>(frame));
  record.seed = plan.seed;
  record.protocol = plan.protocol;
  if (plan.protocol == Protocol::reset) record.gate = to_string(plan.gate);
  record.yardstick = method.yardstick;
  record.reads_codes = method.reads_codes;
  record.deterministic = method.deterministic;
  return record;
}

Replay replay_one(const Plan& plan, const ChosenMethod& method, std::vector<bool> asked) {
  Progress progress(method.text, static_cast<std::int64_t>(plan.sequence.recording.frames()));
  const ReplayOptions options{plan.protocol, plan.gate, method.reads_codes, std::move(asked),
                              [&](FrameIndex frame) { progress.done(frame + 1); }};
  const auto source = plan.sequence.frames();
  const auto instance = method.make(plan.sequence.recording, plan.seed);
  return replay(*instance, *source, plan.sequence.recording, plan.schedule, options);
}

double seconds_spent(const Replay& replayed) {
  Duration wall{0};
  for (const FrameCost& cost : replayed.costs) wall += cost.wall;
  return seconds(wall);
}

/// Runs one method unless that was done before. Returns what went wrong in it, if anything.
std::optional<Failure> run_one(const Plan& plan, const ChosenMethod& method) {
  RunRecord record = record_of(plan, method);
  const auto folder = run_folder(plan.out, record);
  auto targets = asked(method, plan.sequence.recording);
  check_comparison(folder, record);
  if (already_run(folder, record)) {
    fmt::print("{}  kept: the same run is there already\n", padded(method.text, 12));
    return {};
  }
  const Replay replayed = replay_one(plan, method, std::move(targets));
  record.judged_from = replayed.trajectory.judged_from;
  record.failed_from = replayed.trajectory.failed_from;
  record.failures = replayed.failures;
  record.cut_short = replayed.cut_short;
  store_run(folder, record, plan.sequence.recording, replayed);
  fmt::print("{}  {} frames in {:.2f} s\n", padded(method.text, 12), replayed.costs.size(),
             seconds_spent(replayed));
  std::fflush(stdout);
  if (replayed.cut_short)
    throw Error(fmt::format("{} (what was seen of the {} frames before it is kept in {})",
                            replayed.cut_short->what, replayed.cut_short->frame, folder.string()));
  return replayed.failures.empty() ? std::nullopt : std::optional(replayed.failures.front());
}

void print_recording(const Plan& plan) {
  const Recording& recording = plan.sequence.recording;
  const Duration period = recording.period, median = plan.sequence.median_interval;
  fmt::print("{}: {} frames of {}x{}, {:.2f} s, T {:.3f} ms", recording.name, recording.frames(),
             recording.picture.width, recording.picture.height,
             seconds(recording.captured.back() - recording.captured.front()), 1e3 * seconds(period));
  if (5 * std::chrono::abs(median - period) > period)  // metrics.md section 2
    fmt::print(" (median interval {:.3f} ms)", 1e3 * seconds(median));
  std::size_t dropped = 0;
  for (std::size_t frame = 0; frame < plan.schedule.frames(); ++frame)
    dropped += plan.schedule.delivered(frame) ? 0 : 1;
  if (dropped > 0) fmt::print(", {} dropped by {}", dropped, plan.gaps.text());
  fmt::print("\n");
}

}  // namespace

int run(const RunArguments& arguments, const Methods& methods) {
  cv::setNumThreads(1);  // the same bytes and comparable times on any machine
  const Protocol protocol = parse_protocol(arguments.protocol);
  const Gate gate = parse_gate(arguments.gate);
  const auto chosen = chosen_methods(arguments, methods, protocol);
  GapPattern gaps = GapPattern::parse(arguments.gaps);
  Sequence sequence =
      open_sequence(recording_path(arguments.sequence),
                    {arguments.labels, arguments.rate_hz, {}, arguments.format, arguments.topic});
  check_labels(sequence, arguments);
  for (const ChosenMethod& method : chosen) asked(method, sequence.recording);
  const Schedule schedule = gaps.apply(sequence.recording.captured, sequence.recording.period, arguments.seed,
                                       start_frames(sequence.recording));
  prepare_results(arguments.out);
  store_truth(arguments.out, sequence.recording, sequence.fingerprint);
  const Plan plan{std::move(sequence),
                  std::move(gaps),
                  schedule,
                  protocol,
                  gate,
                  arguments.seed,
                  arguments.out,
                  file_fingerprint("/proc/self/exe")};

  print_recording(plan);
  bool failed = false;
  for (const ChosenMethod& method : chosen) {
    if (const auto failure = run_one(plan, method)) {
      failed = true;
      fmt::print(stderr, "relock: {} failed on frame {}: {} (it is scored as failed from there on)\n",
                 method.text, failure->frame, failure->what);
    }
  }
  fmt::print("Results are in {}; see them with `relock timeline {}` and `relock score {}`\n",
             arguments.out.string(), arguments.out.string(), arguments.out.string());
  return failed ? 1 : 0;
}

}  // namespace relock
