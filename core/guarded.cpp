#include <map>
#include <utility>

#include "core/compose.h"
#include "core/motion_memory.h"
#include "core/pursuit.h"

namespace relock {
namespace {

class Guarded final : public Method {
 public:
  Guarded(TrackerFactory make_tracker, std::unique_ptr<Detector> detector, const GuardedOptions& options)
      : make_tracker_(std::move(make_tracker)), detector_(std::move(detector)), options_(options) {}

  bool takes_boxes() const override { return true; }

  void start(const Frame& frame, const Target& target, const Box& box) override {
    targets_.erase(target.id);  // a start that fails must not leave the old tracker running
    Watched fresh{target.code, box, frame.captured, frame.index};
    fresh.pursuit.start(frame, box, make_tracker_(starts_++));
    targets_.emplace(target.id, std::move(fresh));
  }

  Sightings locate(const Frame& frame) override {
    clock_.show(frame.captured);
    if (targets_.empty()) return {};
    bool look = ++since_look_ >= options_.every || clock_.after_gap();
    for (auto& [id, target] : targets_) {
      if (target.started == frame.index) continue;
      if (!target.lost) target.answer = target.pursuit.track(frame, make_tracker_, starts_);
      look |= in_doubt(target) || overdue(target, frame);
    }
    if (look) confirm_or_correct(frame);
    return answers(frame);
  }

 private:
  struct Watched {
    std::optional<Code> code;
    Box last;
    Time confirmed;
    FrameIndex started = -1;
    bool lost = false;
    std::optional<Sighting> answer = {};
    Pursuit pursuit = {};
  };

  bool in_doubt(const Watched& target) const {
    return !target.answer || target.answer->confidence < options_.doubt;
  }
  bool overdue(const Watched& target, const Frame& frame) const {
    return seconds(frame.captured - target.confirmed) > options_.patience_s;
  }

  void confirm_or_correct(const Frame& frame) {
    since_look_ = 0;
    const Sightings detections = detector_->detect(frame.image);
    std::vector<Claimant> claimants;
    for (const auto& [id, target] : targets_)
      claimants.push_back({target.code, target.answer ? bounds(target.answer->outline) : target.last,
                           target.lost || !target.answer});
    const auto claimed = claims(claimants, detections);
    const auto kept = detections.empty() ? nullptr : std::make_shared<const Pursuit::Kept>(frame);
    std::size_t t = 0;
    for (auto& [id, target] : targets_) {
      const auto detection = claimed[t++];
      if (!detection || target.started == frame.index) continue;
      target.confirmed = frame.captured;
      target.lost = false;
      if (!in_doubt(target) && agree(*target.answer, detections[*detection])) continue;
      target.answer = detections[*detection];
      target.pursuit.restart(kept, bounds(target.answer->outline));
    }
  }

  bool agree(const Sighting& tracked, const Sighting& detected) const {
    return norm(centre_of(tracked.outline) - centre_of(detected.outline)) <=
           options_.apart * size_of(detected.outline);
  }

  Sightings answers(const Frame& frame) {
    Sightings all;
    for (auto& [id, target] : targets_) {
      if (target.started == frame.index) continue;
      if (!target.lost && overdue(target, frame)) {
        target.lost = true;
        target.pursuit.give_up();
      }
      auto answer = std::exchange(target.answer, std::nullopt);
      if (target.lost || !answer) continue;
      target.last = bounds(answer->outline);
      answer->track = id;
      all.push_back(*std::move(answer));
    }
    return all;
  }

  TrackerFactory make_tracker_;
  std::unique_ptr<Detector> detector_;
  GuardedOptions options_;
  std::map<TargetId, Watched> targets_;
  MotionMemory clock_;
  int since_look_ = 0;
  std::uint64_t starts_ = 0;
};

}  // namespace

std::unique_ptr<Method> guarded(TrackerFactory make_tracker, std::unique_ptr<Detector> detector,
                                const GuardedOptions& options) {
  return std::make_unique<Guarded>(std::move(make_tracker), std::move(detector), options);
}

}  // namespace relock
