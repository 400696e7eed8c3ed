#include "cli/runs/worker.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <chrono>
#include <sstream>

#include "core/error.h"
#include "eval/trajectory_csv.h"

namespace relock {
namespace {

// Messages of a worker, by their first letter.
constexpr char kNotMade = 'n';  // why
constexpr char kAsking = 'a';   // frame, then the targets given in it
constexpr char kReported =
    'r';  // wall and CPU nanoseconds, real time: when it was there; a line's end, rows of trajectory.csv
constexpr char kFinished = 'f';  // run.json

std::vector<std::int64_t> numbers_in(std::string_view text) {
  std::vector<std::int64_t> all;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    std::int64_t number = 0;
    at = std::from_chars(at, end, number).ptr + 1;
    all.push_back(number);
  }
  return all;
}

ReplayOptions replay_options(const Condition& condition, const PlannedRun& run, const Played& played) {
  ReplayOptions options;
  options.protocol = condition.protocol;
  options.gate = condition.gate;
  options.reads_codes = run.method.reads_codes;
  options.asked = run.asked;
  options.from = played.from;
  options.real_time = condition.real_time;
  return options;
}

/// What the worker does: its life is told frame by frame.
void replay_and_tell(const Matrix& matrix, const PlannedRun& run, const Tell& tell) {
  const Condition& condition = matrix.condition_of(run);
  const Played played = relock::played(matrix, run);
  const auto source = played.frames();
  std::unique_ptr<Method> method;
  try {
    method = run.method.make(played.recording, condition.seed);
  } catch (const std::exception& fault) {
    tell(kNotMade + std::string(fault.what()));
    return;
  } catch (...) {
    tell(kNotMade + std::string("threw something that is no exception when it was made"));
    return;
  }
  ReplayOptions options = replay_options(condition, run, played);
  options.asking = [&](FrameIndex frame, const std::vector<std::size_t>& given) {
    tell(fmt::format("{}{}{}{}", kAsking, frame, given.empty() ? "" : ",", fmt::join(given, ",")));
  };
  std::string message;
  options.reported = [&](const Replay& so_far) {
    const std::size_t frame = so_far.trajectory.frames.size() - 1;
    const bool asked = !so_far.costs.empty() && so_far.costs.back().frame == static_cast<FrameIndex>(frame);
    const FrameCost cost = asked ? so_far.costs.back() : FrameCost{};
    message = fmt::format("{}{},{},{}", kReported, cost.wall.count(), cost.cpu.count(), cost.peak_bytes);
    if (asked && !so_far.answers.empty() && so_far.answers.back().frame == cost.frame)
      message += fmt::format(",{}", ns(so_far.answers.back().finished));
    message += '\n';
    append_report(message, played.recording, so_far.trajectory, frame);
    tell(message);
  };
  const Replay replayed = replay(*method, *source, played.recording, condition.schedule, options);
  RunRecord record = run.record;
  record.judged_from = replayed.trajectory.judged_from;
  record.failed_from = replayed.trajectory.failed_from;
  record.failures = replayed.failures;
  record.cut_short = replayed.cut_short;
  tell(kFinished + to_json_text(record));
}

ChildLimits child_limits(const RunLimits& limits) {
  return {.silence = from_seconds(limits.frame_s),
          .memory_bytes = static_cast<std::uint64_t>(limits.memory_mb * 1e6)};
}

/// A source that ends after some frames.
class FirstFrames final : public FrameSource {
 public:
  FirstFrames(std::unique_ptr<FrameSource> source, std::size_t frames)
      : source_(std::move(source)), left_(frames) {}

  std::span<const Time> captured() const override { return source_->captured(); }
  Size picture_size() const override { return source_->picture_size(); }
  std::optional<FrameStamp> next() override {
    if (left_ == 0) return {};
    --left_;
    return source_->next();
  }
  Image image() override { return source_->image(); }

 private:
  std::unique_ptr<FrameSource> source_;
  std::size_t left_;
};

}  // namespace

Worker::Worker(const Matrix& matrix, const PlannedRun& run, const RunLimits& limits)
    : matrix_(matrix),
      run_(run),
      rows_(trajectory_header()),
      child_([&](const Tell& tell) { replay_and_tell(matrix, run, tell); }, child_limits(limits)) {}

std::optional<FinishedRun> Worker::look() {
  for (const std::string& message : child_.take()) hear(message);
  if (const auto end = child_.end()) return finished(*end);
  return {};
}

void Worker::hear(const std::string& message) {
  const std::string_view text = std::string_view(message).substr(1);
  switch (message.front()) {
    case kNotMade:
      not_made_ = std::string(text);
      break;
    case kFinished:
      record_ = parse_record(std::string(text), "a worker's answer");
      break;
    case kAsking: {
      const auto numbers = numbers_in(text);
      asked_ = numbers.at(0);
      given_.assign(numbers.begin() + 1, numbers.end());
      break;
    }
    case kReported: {
      const std::size_t head = text.find('\n');
      const auto numbers = numbers_in(text.substr(0, head));
      if (asked_)
        costs_.push_back({*asked_, Duration(numbers.at(0)), Duration(numbers.at(1)), numbers.at(2)});
      if (asked_ && numbers.size() > 3) {
        const auto& captured = matrix_.sequence_of(run_).recording.captured;
        answers_.push_back({*asked_, captured[static_cast<std::size_t>(*asked_)], time_ns(numbers[3])});
      }
      asked_.reset();
      ++frames_done_;
      rows_ += text.substr(head + 1);
      break;
    }
    default:
      break;
  }
}

FinishedRun Worker::finished(const ChildEnd& end) {
  FinishedRun done{run_.record, std::move(rows_), std::move(costs_), std::move(answers_)};
  if (record_) {
    done.record = *std::move(record_);
  } else if (not_made_) {
    complete_failed(done, {0, *not_made_});
  } else if (end.kind == ChildEnd::Kind::threw && end.what != kRanOutOfMemory) {
    throw Error(end.what);
  } else {
    complete_failed(done, {asked_.value_or(static_cast<FrameIndex>(frames_done_)), end.what, end.tail});
  }
  return done;
}

void Worker::complete_failed(FinishedRun& done, const Failure& failure) {
  const Condition& condition = matrix_.condition_of(run_);
  const Played played = relock::played(matrix_, run_);
  const Recording& recording = played.recording;
  Trajectory trajectory;
  trajectory.reads_codes = run_.method.reads_codes;
  trajectory.judged_from =
      judged_from(recording, replay_options(condition, run_, played), run_.method.takes_boxes);
  trajectory.failed_from.resize(recording.targets.size());
  std::istringstream rows(done.trajectory);
  read_trajectory(rows, "a worker's answer", recording, trajectory);
  const auto last = static_cast<FrameIndex>(recording.frames()) - 1;
  fail_from(trajectory, std::min(failure.frame, last), given_, condition.schedule);
  std::ostringstream text;
  write_trajectory(text, recording, trajectory);
  done.trajectory = text.str();
  done.record.judged_from = trajectory.judged_from;
  done.record.failed_from = trajectory.failed_from;
  done.record.failures = {failure};
}

std::optional<double> trial_seconds_per_frame(const Matrix& matrix, const PlannedRun& run) {
  constexpr std::size_t kFrames = 10;
  using Clock = std::chrono::steady_clock;
  const Condition& condition = matrix.condition_of(run);
  const Played played = relock::played(matrix, run);
  std::size_t start = 0;
  for (const auto& first : first_startable(played.recording, played.from))
    if (first) start = std::max(start, static_cast<std::size_t>(*first));
  const std::size_t end = std::min(start + kFrames, played.recording.frames());
  const auto trial = run_in_child(
      [&](const Tell& tell) {
        const auto method = run.method.make(played.recording, condition.seed);
        FirstFrames source(played.frames(), end);
        ReplayOptions options = replay_options(condition, run, played);
        options.real_time.reset();
        Clock::time_point begun = Clock::now();
        options.reported = [&](const Replay& so_far) {
          const std::size_t done = so_far.trajectory.frames.size();
          if (done <= start) begun = Clock::now();
          if (done > start)
            tell(fmt::format("{}", std::chrono::duration<double>(Clock::now() - begun).count() /
                                       static_cast<double>(done - start)));
        };
        replay(*method, source, played.recording, Schedule(played.recording.frames()), options);
      },
      {.silence = std::chrono::seconds(20)});
  if (trial.messages.empty()) return {};
  return std::strtod(trial.messages.back().c_str(), nullptr);
}

}  // namespace relock
