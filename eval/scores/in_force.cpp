#include "eval/scores/in_force.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "eval/judgement/visible_time.h"

namespace relock {
namespace {

/// Until when an answer must be finished to be in force at a frame.
Time end_of(const Recording& recording, std::size_t frame) {
  return frame + 1 < recording.frames() ? recording.captured[frame + 1]
                                        : recording.captured[frame] + recording.period;
}

/// Whether the method has failed for good: whoever asks it hears nothing any more.
bool gone(const Trajectory& trajectory, std::size_t frame) {
  bool any = false;
  for (std::size_t t = 0; t < trajectory.failed_from.size(); ++t) {
    const auto& from = trajectory.failed_from[t];
    const bool failed = from && *from <= static_cast<FrameIndex>(frame);
    if (trajectory.judged_from[t] && !failed) return false;
    any = any || failed;
  }
  return any;
}

/// The same, judged from the first frame on: an answer may be right on a frame that scores leave out.
Trajectory judged_from_the_first_frame(Trajectory trajectory) {
  for (auto& from : trajectory.judged_from)
    if (from) from = 0;
  return trajectory;
}

/// Tells why answers in force on one target are no Hits.
class Blame {
 public:
  Blame(const Trajectory& trajectory, const InForce& in_force, const Evaluation& on_own_frames,
        std::size_t target)
      : trajectory_(trajectory),
        in_force_(in_force),
        own_(on_own_frames.targets[target].judgements),
        t_(target) {
    for (std::size_t frame = 0; frame < trajectory.frames.size(); ++frame)
      if (given(frame)) starts_.push_back(static_cast<FrameIndex>(frame));
  }

  /// To be asked in order of frames.
  LostTo at(std::size_t frame) {
    const auto now = static_cast<FrameIndex>(frame);
    note_delivery_up_to(now);
    const auto& failed = trajectory_.failed_from[t_];
    if (failed && *failed <= now) return LostTo::failure;
    const auto& answer = in_force_.answers[frame];
    if (!waits_for_its_start(now) && !not_there_yet(now, answer) && !right_on_its_own_frame(*answer))
      return LostTo::failure;
    // Nothing newer was delivered since that answer's frame: even at once, there was nothing to answer.
    const bool newest = newest_delivered_ == answer;
    return newest ? LostTo::gaps : LostTo::slowness;
  }

 private:
  bool given(std::size_t frame) const {
    const auto& given = trajectory_.frames[frame].given;
    return std::binary_search(given.begin(), given.end(), t_);
  }

  void note_delivery_up_to(FrameIndex now) {
    for (; seen_ <= now; ++seen_)
      if (trajectory_.frames[static_cast<std::size_t>(seen_)].delivery != Delivery::dropped)
        newest_delivered_ = seen_;
  }

  /// Its first start is still to come: the method was busy with other targets when it was due.
  bool waits_for_its_start(FrameIndex now) const { return !starts_.empty() && starts_.front() > now; }

  /// No answer to a frame after its last start.
  bool not_there_yet(FrameIndex now, const std::optional<FrameIndex>& answer) const {
    if (!answer) return true;
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), now);
    return next != starts_.begin() && *answer <= *std::prev(next);
  }

  bool right_on_its_own_frame(FrameIndex answer) const {
    const Verdict verdict = own_[static_cast<std::size_t>(answer)].verdict;
    return verdict == Verdict::Hit || verdict == Verdict::CorrectReject;
  }

  const Trajectory& trajectory_;
  const InForce& in_force_;
  const std::vector<Judgement>& own_;
  const std::size_t t_;
  std::vector<FrameIndex> starts_;
  FrameIndex seen_ = 0;
  std::optional<FrameIndex> newest_delivered_;
};

void add_own_frames(RealTimeScores& scores, const Recording& recording, const Evaluation& own,
                    std::size_t t) {
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const Verdict verdict = own.targets[t].judgements[frame].verdict;
    scores.own += could_hit(recording.truth_of(frame, t), verdict) ? 1 : 0;
    scores.own_hits += verdict == Verdict::Hit ? 1 : 0;
    scores.skipped += verdict == Verdict::Skipped ? 1 : 0;
    scores.delivered += verdict != Verdict::NotStarted && verdict != Verdict::Dropped ? 1 : 0;
  }
}

}  // namespace

InForce in_force(const Recording& recording, const Trajectory& trajectory, std::span<const Answer> answers) {
  InForce result;
  result.trajectory.method = trajectory.method;
  result.trajectory.reads_codes = trajectory.reads_codes;
  result.trajectory.judged_from = trajectory.judged_from;
  result.trajectory.failed_from = trajectory.failed_from;
  std::optional<FrameIndex> last;
  auto next = answers.begin();
  for (std::size_t frame = 0; frame < trajectory.frames.size(); ++frame) {
    for (; next != answers.end() && next->frame <= static_cast<FrameIndex>(frame) &&
           next->finished <= end_of(recording, frame);
         ++next)
      last = next->frame;
    if (gone(trajectory, frame)) last.reset();
    FrameReport report;
    report.given = trajectory.frames[frame].given;
    if (last) report.sightings = trajectory.frames[static_cast<std::size_t>(*last)].sightings;
    result.trajectory.frames.push_back(std::move(report));
    result.answers.push_back(last);
    result.answer_age_s.push_back(
        last ? seconds(recording.captured[frame] - recording.captured[static_cast<std::size_t>(*last)])
             : std::numeric_limits<double>::infinity());
  }
  return result;
}

RealTimeScores& RealTimeScores::operator+=(const RealTimeScores& other) {
  own += other.own, own_hits += other.own_hits;
  skipped += other.skipped, delivered += other.delivered;
  in_force += other.in_force, hits += other.hits;
  for (std::size_t cause = 0; cause < kLostTo; ++cause) lost[cause] += other.lost[cause];
  answer_age_s.insert(answer_age_s.end(), other.answer_age_s.begin(), other.answer_age_s.end());
  return *this;
}

std::vector<RealTimeScores> score_real_time(const Recording& recording, const Trajectory& trajectory,
                                            std::span<const Answer> answers, const Gate& gate) {
  const InForce held = in_force(recording, trajectory, answers);
  const Evaluation own = evaluate(recording, trajectory, gate);
  const Evaluation from_the_first = evaluate(recording, judged_from_the_first_frame(trajectory), gate);
  const Evaluation judged = evaluate(recording, held.trajectory, gate);
  std::vector<RealTimeScores> all(recording.targets.size());
  for (std::size_t t = 0; t < all.size(); ++t) {
    add_own_frames(all[t], recording, own, t);
    Blame blame(trajectory, held, from_the_first, t);
    for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
      const Verdict verdict = judged.targets[t].judgements[frame].verdict;
      if (!could_hit(recording.truth_of(frame, t), verdict)) continue;
      ++all[t].in_force;
      all[t].answer_age_s.push_back(held.answer_age_s[frame]);
      if (verdict == Verdict::Hit) {
        ++all[t].hits;
      } else {
        ++all[t].lost[static_cast<std::size_t>(blame.at(frame))];
      }
    }
  }
  return all;
}

}  // namespace relock
