#include "cli/runs/matrix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <opencv2/core/version.hpp>
#include <set>

#include "cli/recordings.h"
#include "cli/runs/folder.h"
#include "cli/runs/truth.h"
#include "cli/version.h"
#include "core/error.h"
#include "sequences/gaps.h"
#include "sequences/reversed.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

Sequence opened(const PlannedSequence& planned) {
  Sequence sequence = open_sequence(recording_path(planned.path), planned.open);
  const Recording& recording = sequence.recording;
  if (recording.targets.empty())
    throw Error(
        fmt::format("{} has no labels.csv, and without truth nothing can be scored; give --labels FILE",
                    planned.path.string()));
  const auto visible = [](const TargetTruth& truth) { return truth.label == Label::visible; };
  if (std::none_of(recording.truth.begin(), recording.truth.end(), visible))
    throw Error(fmt::format("no target of {} is ever visible, so there is nothing to score", recording.name));
  return sequence;
}

/// Frames that no pattern may take: where methods are started.
std::vector<FrameIndex> start_frames(const Recording& recording) {
  std::vector<FrameIndex> frames;
  for (const auto& start : first_startable(recording))
    if (start) frames.push_back(*start);
  return frames;
}

/// Likewise, of all runs of protocol multistart: every one of them loses the same frames.
std::vector<FrameIndex> start_frames(const Recording& recording, const std::vector<Anchor>& anchors) {
  const Recording turned = reflected(recording);
  const auto last = static_cast<FrameIndex>(recording.frames()) - 1;
  std::vector<FrameIndex> frames;
  for (const Anchor& anchor : anchors) {
    const bool forward = anchor.direction == Direction::forward;
    for (const auto& start :
         first_startable(forward ? recording : turned, start_of(anchor, recording.frames())))
      if (start) frames.push_back(forward ? *start : last - *start);
  }
  return frames;
}

/// One for every run of protocol multistart.
void add_anchored(std::vector<Condition>& all, const Condition& of_all, const Recording& recording,
                  const GapPattern& pattern) {
  const auto from = anchors(recording);
  if (from.empty())
    throw Error(
        fmt::format("{} is too short for protocol multistart: no target can be started with {} frames "
                    "left to play, forward or backward; use protocol once",
                    recording.name, MultistartOptions{}.fewest));
  const Schedule schedule =
      pattern.apply(recording.captured, recording.period, of_all.seed, start_frames(recording, from));
  for (const Anchor& anchor : from) {
    all.push_back(of_all);
    all.back().anchor = anchor;
    all.back().schedule = anchor.direction == Direction::forward ? schedule : reflected(schedule);
  }
}

std::vector<Condition> conditions(const Plan& plan, const std::vector<Sequence>& sequences) {
  std::vector<Condition> all;
  std::vector<GapPattern> patterns;
  for (const std::string& text : plan.gaps) patterns.push_back(GapPattern::parse(text));
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    const Recording& recording = sequences[s].recording;
    for (const GapPattern& pattern : patterns)
      for (const Protocol protocol : plan.protocols)
        for (const std::uint64_t seed : plan.seeds) {
          const Condition condition{
              s,
              pattern.text(),
              protocol,
              seed,
              plan.gate,
              pattern.apply(recording.captured, recording.period, seed, start_frames(recording)),
              plan.real_time};
          if (protocol == Protocol::multistart) {
            add_anchored(all, condition, recording, pattern);
          } else {
            all.push_back(condition);
          }
        }
  }
  return all;
}

std::vector<ChosenMethod> chosen_methods(const Plan& plan, const Methods& methods) {
  std::vector<ChosenMethod> chosen;
  for (const MethodSpec& spec : plan.methods) {
    const auto same = [&](const ChosenMethod& other) { return other.text == spec.text(); };
    if (std::none_of(chosen.begin(), chosen.end(), same)) chosen.push_back(choose(methods, spec));
  }
  return chosen;
}

std::vector<bool> asked_about(const ChosenMethod& method, const Recording& recording) {
  std::vector<bool> all;
  for (const Target& target : recording.targets) all.push_back(method.asked_about(target));
  return all;
}

/// Why a method cannot be run there; empty if it can.
std::string hindrance(const ChosenMethod& method, const Condition& condition, const Recording& recording) {
  if (method.needs_start && condition.protocol == Protocol::detect)
    return fmt::format("{} needs a box to start from, and protocol detect gives none; use once or reset",
                       method.text);
  if (!method.takes_boxes && condition.protocol == Protocol::vot)
    return fmt::format(
        "{} takes no box, and protocol vot counts how often one has to be handed over; use once or detect",
        method.text);
  const auto asked = asked_about(method, recording);
  if (std::find(asked.begin(), asked.end(), true) == asked.end())
    return fmt::format(
        "{} reads codes of {}, and no target of {} has one; give the target's code in "
        "recording.toml",
        method.text, fmt::join(method.reads, ", "), recording.name);
  return {};
}

RunRecord record_of(const Matrix& matrix, const PlannedRun& run, const std::string& program) {
  const Condition& condition = matrix.condition_of(run);
  RunRecord record;
  record.relock_version = kVersion;
  record.program = program + run.method.program;
  record.opencv_version = CV_VERSION;
  record.recording = matrix.sequence_of(run).recording.name;
  record.fingerprint = matrix.sequence_of(run).fingerprint;
  record.method = run.method.text;
  record.options = run.method.options;
  record.gaps = condition.gaps;
  const bool backward = condition.anchor && condition.anchor->direction == Direction::backward;
  const Schedule as_recorded = backward ? reflected(condition.schedule) : condition.schedule;
  for (std::size_t frame = 0; frame < as_recorded.frames(); ++frame)
    if (!as_recorded.delivered(frame)) record.dropped.push_back(static_cast<FrameIndex>(frame));
  record.anchor = condition.anchor;
  record.seed = condition.seed;
  record.protocol = condition.protocol;
  if (condition.protocol == Protocol::reset) record.gate = to_string(condition.gate);
  if (condition.real_time) {
    record.real_time = to_string(condition.real_time->waiting);
    record.latency = condition.real_time->latency.text;
  }
  record.yardstick = run.method.yardstick;
  record.reads_codes = run.method.reads_codes;
  const bool measured = condition.real_time && condition.real_time->latency.kind == Latency::Kind::measured;
  record.deterministic = run.method.deterministic && !measured;
  return record;
}

/// Throws Error when a protocol has no real time.
void check_real_time(const Plan& plan) {
  if (!plan.real_time) return;
  for (const Protocol protocol : plan.protocols)
    if (protocol == Protocol::multistart || protocol == Protocol::vot)
      throw Error(
          fmt::format("protocol {} has no real time: {}; use once, reset or detect, or leave out real time",
                      to_string(protocol),
                      protocol == Protocol::vot ? "it counts frames, and wants an answer to every one"
                                                : "half of its runs go backward"));
}

/// Adds the runs of one condition. `fits`: for each method, whether it was found to fit anywhere.
void add_runs(Matrix& matrix, std::size_t condition, const std::vector<ChosenMethod>& chosen,
              const Methods& methods, std::vector<bool>& fits) {
  const Condition& c = matrix.conditions[condition];
  const Recording& recording = matrix.sequences[c.sequence].recording;
  const auto add = [&](const ChosenMethod& method) {
    matrix.runs.push_back({condition, method, asked_about(method, recording), {}, {}, false});
  };
  for (std::size_t m = 0; m < chosen.size(); ++m) {
    const std::string why = hindrance(chosen[m], c, recording);
    if (why.empty()) {
      add(chosen[m]);
      fits[m] = true;
    } else if (std::find(matrix.left_out.begin(), matrix.left_out.end(), why) == matrix.left_out.end()) {
      matrix.left_out.push_back(why);
    }
  }
  for (const ChosenMethod& yardstick : yardsticks(methods, c.protocol != Protocol::detect, chosen))
    add(yardstick);
}

void settle_folders(Matrix& matrix, const Plan& plan) {
  const std::string program = file_fingerprint("/proc/self/exe");
  for (const Sequence& sequence : matrix.sequences)
    check_truth(plan.out, sequence.recording, sequence.fingerprint);
  std::set<fs::path> taken;
  for (PlannedRun& run : matrix.runs) {
    run.record = record_of(matrix, run, program);
    run.folder = run_folder(plan.out, run.record);
    if (!taken.insert(run.folder).second)
      throw Error(
          fmt::format("two runs of this plan would be in {}; give the recordings names of their own in "
                      "recording.toml, or leave one of the two out",
                      run.folder.string()));
    check_comparison(run.folder, run.record);
    run.there = already_run(run.folder, run.record);
  }
}

}  // namespace

Matrix multiply_out(const Plan& plan, const Methods& methods) {
  check_real_time(plan);
  const auto chosen = chosen_methods(plan, methods);
  for (const std::string& text : plan.gaps) GapPattern::parse(text);  // told before anything is opened
  Matrix matrix;
  std::vector<bool> fits(chosen.size(), false);
  for (const PlannedSequence& planned : plan.sequences) matrix.sequences.push_back(opened(planned));
  matrix.conditions = conditions(plan, matrix.sequences);
  for (std::size_t c = 0; c < matrix.conditions.size(); ++c) add_runs(matrix, c, chosen, methods, fits);
  const auto nowhere = std::find(fits.begin(), fits.end(), false);
  if (nowhere != fits.end()) {
    const auto& method = chosen[static_cast<std::size_t>(nowhere - fits.begin())];
    throw Error(hindrance(method, matrix.conditions.front(),
                          matrix.sequences[matrix.conditions.front().sequence].recording));
  }
  settle_folders(matrix, plan);
  return matrix;
}

Played played(const Matrix& matrix, const PlannedRun& run) {
  const Sequence& sequence = matrix.sequence_of(run);
  const std::optional<Anchor>& anchor = matrix.condition_of(run).anchor;
  if (!anchor) return {sequence.recording, sequence.frames};
  const FrameIndex from = start_of(*anchor, sequence.recording.frames());
  if (anchor->direction == Direction::forward) return {sequence.recording, sequence.frames, from};
  return {reflected(sequence.recording), [frames = sequence.frames] { return reversed(frames); }, from};
}

std::size_t shown_frames(const Condition& condition) {
  std::size_t count = 0;
  const FrameIndex from = condition.anchor ? start_of(*condition.anchor, condition.schedule.frames()) : 0;
  for (auto frame = static_cast<std::size_t>(from); frame < condition.schedule.frames(); ++frame)
    count += condition.schedule.delivered(frame) ? 1 : 0;
  return count;
}

std::size_t dropped_frames(const Condition& condition) {
  std::size_t count = 0;
  for (std::size_t frame = 0; frame < condition.schedule.frames(); ++frame)
    count += condition.schedule.delivered(frame) ? 0 : 1;
  return count;
}

}  // namespace relock
