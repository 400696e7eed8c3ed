#include "eval/replay/replay.h"

#include <sys/resource.h>

#include <fmt/format.h>

#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <new>

#include "core/error.h"
#include "core/outline_csv.h"
#include "eval/judgement/evaluation.h"
#include "eval/replay/vot_rules.h"
#include "eval/trajectory_csv.h"

namespace relock {
namespace {

Duration process_cpu() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + Duration(now.tv_nsec);
}

std::int64_t peak_memory_bytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return 1024 * std::int64_t{used.ru_maxrss};
}

/// Times what happens between its making and `cost`.
class Stopwatch {
 public:
  FrameCost cost(FrameIndex frame) const {
    return {frame, std::chrono::steady_clock::now() - wall_, process_cpu() - cpu_, peak_memory_bytes()};
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  Duration cpu_ = process_cpu();
};

void check_sighting(const Sighting& sighting, const Recording& recording) {
  if (!finite(sighting.centre) || !well_formed(sighting.outline) ||
      size_of(sighting.outline) < kSmallestOutline_px)
    throw Error("the answer is not finite or has no size");
  if (!(sighting.confidence >= 0 && sighting.confidence <= 1))
    throw Error(
        fmt::format("the answer's confidence is {}; it must be between 0 and 1", sighting.confidence));
  if (sighting.blur &&
      !(std::isfinite(sighting.blur->direction_rad) && std::isfinite(sighting.blur->length_px)))
    throw Error("the answer's blur is not finite");
  if (sighting.code) parse_code(to_string(*sighting.code));
  if (sighting.track) {
    const auto same = [&](const Target& target) { return target.id == *sighting.track; };
    if (std::none_of(recording.targets.begin(), recording.targets.end(), same))
      throw Error(fmt::format("the answer follows \"{}\", which is no target", *sighting.track));
  }
}

/// What is said twice in the same words is said once.
Sightings each_once(const Sightings& said) {
  Sightings once;
  for (const Sighting& sighting : said)
    if (std::find(once.begin(), once.end(), sighting) == once.end()) once.push_back(sighting);
  return once;
}

/// To be called in a handler: what the method threw, which may be no exception at all.
std::string sentence_of_what_was_thrown() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "ran out of memory";
  } catch (const std::exception& fault) {
    return fault.what();
  } catch (...) {
    return "threw something that is no exception";
  }
}

/// One replay: which targets are started when, and what was said.
class Run {
 public:
  Run(Method& method, const Recording& recording, const Schedule& schedule, const ReplayOptions& options)
      : method_(method),
        recording_(recording),
        options_(options),
        starts_(first_startable(recording, options.from)),
        watches_(recording.targets.size(), LockWatch(recording.period)),
        started_(recording.targets.size(), false),
        restart_due_(recording.targets.size(), false),
        off_until_(recording.targets.size()) {
    if (options.real_time) clock_.emplace(recording.captured, schedule, options.real_time->waiting);
    Trajectory& trajectory = result_.trajectory;
    trajectory.reads_codes = options.reads_codes;
    trajectory.judged_from = judged_from(recording, options, method.takes_boxes());
    trajectory.failed_from.resize(targets());
  }

  void show(const Frame& frame) {
    FrameReport report;
    report.given = due_starts(frame.index);
    report.withheld = withheld_on(frame.index);
    if (options_.asking) options_.asking(frame.index, report.given);
    Stopwatch watch;
    start(frame, report.given);
    ask(frame, report);
    result_.costs.push_back(watch.cost(frame.index));
    if (clock_) note_answer(result_.costs.back());
    add(std::move(report));
  }

  void drop() { add({.delivery = Delivery::dropped}); }
  /// Whether the method is busy until the frame's place is taken.
  bool misses(FrameIndex frame) const { return clock_ && !clock_->comes_to(frame); }
  void skip() { add({.delivery = Delivery::skipped}); }
  /// Whether the protocol keeps the frame from the method altogether.
  bool withholds(FrameIndex frame) const {
    const auto waits = [&](std::size_t t) { return failed(t) || withheld_from(t, frame); };
    bool any = frame < options_.from;
    for (std::size_t t = 0; t < targets(); ++t) {
      if (!asked(t) || !starts_[t]) continue;
      if (!waits(t)) return false;
      any = any || withheld_from(t, frame);
    }
    return any;
  }
  void withhold(FrameIndex frame) {
    FrameReport report;
    report.withheld = withheld_on(frame);
    add(std::move(report));
  }
  void cut_short(Failure why) { result_.cut_short = std::move(why); }
  Replay result() && { return std::move(result_); }

 private:
  std::size_t targets() const { return recording_.targets.size(); }
  bool asked(std::size_t t) const { return options_.asked.empty() || options_.asked[t]; }
  bool hands_boxes() const { return options_.protocol != Protocol::detect && method_.takes_boxes(); }

  bool start_is_due(std::size_t t, FrameIndex frame) const {
    if (!asked(t) || failed(t) || !starts_[t]) return false;
    if (!started_[t])
      return frame >= *starts_[t] && startable(recording_, static_cast<std::size_t>(frame), t);
    const bool due = options_.protocol == Protocol::vot
                         ? off_until_[t] && frame >= *off_until_[t]
                         : options_.protocol == Protocol::reset && restart_due_[t];
    return due && startable(recording_, static_cast<std::size_t>(frame), t);
  }

  bool withheld_from(std::size_t t, FrameIndex frame) const {
    return frame < options_.from || (off_until_[t] && !failed(t) && !start_is_due(t, frame));
  }

  std::vector<std::size_t> withheld_on(FrameIndex frame) const {
    std::vector<std::size_t> all;
    for (std::size_t t = 0; t < targets(); ++t)
      if (withheld_from(t, frame)) all.push_back(t);
    return all;
  }

  std::vector<std::size_t> due_starts(FrameIndex frame) const {
    std::vector<std::size_t> due;
    for (std::size_t t = 0; hands_boxes() && t < targets(); ++t)
      if (start_is_due(t, frame)) due.push_back(t);
    return due;
  }

  void start(const Frame& frame, const std::vector<std::size_t>& due) {
    for (const std::size_t t : due) {
      started_[t] = true;
      restart_due_[t] = false;
      off_until_[t].reset();
      const auto& truth = recording_.truth_of(static_cast<std::size_t>(frame.index), t);
      try {
        method_.start(frame, recording_.targets[t], bounds(*truth.outline));
      } catch (...) {
        fail(t, frame.index, sentence_of_what_was_thrown());
      }
    }
  }

  void ask(const Frame& frame, FrameReport& report) {
    if (all_failed()) return;
    try {
      Sightings said = method_.locate(frame);
      for (const Sighting& sighting : said) check_sighting(sighting, recording_);
      // As the file will have them, so that replay and scoring judge the same numbers.
      for (Sighting& sighting : said) sighting = as_stored(std::move(sighting));
      // What still runs of a tracker that VOT has called off is not asked.
      std::erase_if(said, [&](const Sighting& sighting) {
        return std::any_of(report.withheld.begin(), report.withheld.end(),
                           [&](std::size_t t) { return sighting.track == recording_.targets[t].id; });
      });
      report.sightings = each_once(said);
    } catch (...) {
      for (std::size_t t = 0; t < targets(); ++t) mark_failed(t, frame.index);
      result_.failures.push_back({frame.index, sentence_of_what_was_thrown()});
    }
  }

  void note_answer(const FrameCost& cost) {
    const bool nothing_to_do =
        hands_boxes() && std::find(started_.begin(), started_.end(), true) == started_.end();
    const Duration latency = options_.real_time->latency.of(cost.frame, cost.wall);
    const Answer answer = clock_->answered(cost.frame, nothing_to_do || all_failed() ? Duration{0} : latency);
    if (!all_failed()) result_.answers.push_back(answer);
  }

  bool failed(std::size_t t) const { return result_.trajectory.failed_from[t].has_value(); }
  bool all_failed() const {
    for (std::size_t t = 0; t < targets(); ++t)
      if (asked(t) && !failed(t)) return false;
    return true;
  }
  void mark_failed(std::size_t t, FrameIndex frame) {
    if (!failed(t)) result_.trajectory.failed_from[t] = frame;
  }
  void fail(std::size_t t, FrameIndex frame, const std::string& why) {
    mark_failed(t, frame);
    result_.failures.push_back({frame, fmt::format("target {}: {}", recording_.targets[t].id, why)});
  }

  /// Writes the report down and, where losses are to be answered, follows the locks.
  void add(FrameReport report) {
    Trajectory& trajectory = result_.trajectory;
    const std::size_t frame = trajectory.frames.size();
    if (options_.protocol == Protocol::reset) {
      const auto judged = judge_frame(recording_, frame, report, trajectory, options_.gate);
      for (std::size_t t = 0; t < targets(); ++t) {
        watches_[t].observe(observation(recording_, frame, t, judged.targets[t], report.sightings));
        // Relocked by itself in time: nothing to answer. Gone meanwhile: it is started when it is back.
        if (watches_[t].state() == State::Lost) restart_due_[t] = true;
        if (watches_[t].state() == State::Locked) restart_due_[t] = false;
      }
    }
    if (options_.protocol == Protocol::vot && report.delivery == Delivery::delivered)
      call_off_who_missed(frame, report);
    trajectory.frames.push_back(std::move(report));
    if (options_.reported) options_.reported(result_);
  }

  void call_off_who_missed(std::size_t frame, const FrameReport& report) {
    for (std::size_t t = 0; t < targets(); ++t) {
      const bool starts = std::binary_search(report.given.begin(), report.given.end(), t);
      if (started_[t] && !failed(t) && !starts && !off_until_[t] &&
          misses_by_vot(recording_, frame, t, report))
        off_until_[t] = static_cast<FrameIndex>(frame) + kVotSkip;
    }
  }

  Method& method_;
  const Recording& recording_;
  const ReplayOptions& options_;
  std::vector<std::optional<FrameIndex>> starts_;
  std::vector<LockWatch> watches_;
  std::optional<VirtualClock> clock_;  // real time
  std::vector<bool> started_;
  std::vector<bool> restart_due_;  // protocol reset: a loss was declared and not yet answered
  // Protocol vot: failed by its rules, and not started before this frame.
  std::vector<std::optional<FrameIndex>> off_until_;
  Replay result_;
};

}  // namespace

std::vector<std::optional<FrameIndex>> judged_from(const Recording& recording, const ReplayOptions& options,
                                                   bool takes_boxes) {
  auto from = first_startable(recording, options.from);
  for (std::size_t t = 0; t < from.size(); ++t) {
    if (options.protocol == Protocol::detect) from[t] = 0;
    // The start frame is left out for methods that are handed no box, too: they are judged from the next one.
    else if (from[t] && !takes_boxes)
      ++*from[t];
    if (!options.asked.empty() && !options.asked[t]) from[t].reset();
  }
  return from;
}

void fail_from(Trajectory& trajectory, FrameIndex frame, const std::vector<std::size_t>& given,
               const Schedule& schedule) {
  for (std::size_t i = trajectory.frames.size(); i < schedule.frames(); ++i)
    trajectory.frames.push_back(
        {.delivery = schedule.delivered(i) ? Delivery::delivered : Delivery::dropped});
  trajectory.frames.at(static_cast<std::size_t>(frame)).given = given;
  for (auto& failed : trajectory.failed_from) {
    if (!failed) failed = frame;
  }
}

Replay replay(Method& method, FrameSource& source, const Recording& recording, const Schedule& schedule,
              const ReplayOptions& options) {
  Run run(method, recording, schedule, options);
  while (const auto stamp = source.next()) {
    if (!schedule.delivered(static_cast<std::size_t>(stamp->index))) {
      run.drop();
      continue;
    }
    if (run.withholds(stamp->index)) {
      run.withhold(stamp->index);
      continue;
    }
    if (run.misses(stamp->index)) {
      run.skip();
      continue;
    }
    Image image;
    try {
      image = source.image();
    } catch (const Error& fault) {
      run.cut_short({stamp->index, fault.what()});
      break;
    }
    run.show({stamp->index, stamp->captured, image});
  }
  return std::move(run).result();
}

}  // namespace relock
