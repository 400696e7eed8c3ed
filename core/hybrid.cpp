#include <utility>

#include "core/compose.h"
#include "core/motion_memory.h"
#include "core/pursuit.h"

namespace relock {
namespace {

class Hybrid final : public Method {
 public:
  Hybrid(std::unique_ptr<Detector> detector, TrackerFactory make_tracker, const HybridOptions& options)
      : detector_(std::move(detector)), make_tracker_(std::move(make_tracker)), options_(options) {}

  bool takes_boxes() const override { return true; }

  void start(const Frame& frame, const Target& target, const Box& box) override {
    // Strangers and the target that was there before: one of them may be this one.
    std::erase_if(targets_, [&](const Followed& f) { return !f.id || *f.id == target.id; });
    boxes_given_ = true;
    Followed fresh{target.id, target.code, box, frame.captured, frame.index};
    fresh.pursuit.start(frame, box, make_tracker_(starts_++));
    targets_.push_back(std::move(fresh));
  }

  Sightings locate(const Frame& frame) override {
    clock_.show(frame.captured);
    bool look = ++since_look_ >= options_.every || clock_.after_gap() || (targets_.empty() && !boxes_given_);
    for (Followed& target : targets_) target.answer.reset(), target.asked = target.believed = false;
    if (!look) look = any_in_doubt(frame);
    Sightings strangers;
    if (look) strangers = take_detections(frame);
    for (Followed& target : targets_) ask(target, frame);
    return answers(frame, std::move(strangers));
  }

 private:
  struct Followed {
    std::optional<TargetId> id;  // empty: nobody handed it over
    std::optional<Code> code;
    Box last;
    Time detected;
    FrameIndex started = -1;  // when it was handed over
    bool lost = false;
    bool asked = false, believed = false;  // its tracker, about this frame
    std::optional<Sighting> answer = {};
    Pursuit pursuit = {};
  };

  bool any_in_doubt(const Frame& frame) {
    bool doubt = false;
    for (Followed& target : targets_) {
      ask(target, frame);
      doubt |= target.started != frame.index && !target.believed;
    }
    return doubt;
  }

  /// The tracker's answer, once for each frame, where there is no detection.
  void ask(Followed& target, const Frame& frame) {
    if (target.asked || target.believed || target.started == frame.index) return;
    target.asked = true;
    target.answer = target.pursuit.track(frame, make_tracker_, starts_);
    target.believed = target.answer && target.answer->confidence >= options_.doubt;
  }

  /// Gives every target the detection that is it; returns those that are nobody's, if they are not followed
  /// from now on.
  Sightings take_detections(const Frame& frame) {
    since_look_ = 0;
    const Sightings detections = detector_->detect(frame.image);
    std::vector<Claimant> claimants;
    for (const Followed& target : targets_) claimants.push_back({target.code, target.last, target.lost});
    const auto claimed = claims(claimants, detections);
    const auto kept = detections.empty() ? nullptr : std::make_shared<const Pursuit::Kept>(frame);
    std::vector<bool> taken(detections.size(), false);
    for (std::size_t t = 0; t < claimed.size(); ++t) {
      if (!claimed[t]) continue;
      taken[*claimed[t]] = true;
      if (targets_[t].started != frame.index) detected(targets_[t], detections[*claimed[t]], kept);
    }
    Sightings strangers;
    for (std::size_t d = 0; d < detections.size(); ++d) {
      if (taken[d]) continue;
      if (boxes_given_) {
        strangers.push_back(detections[d]);
      } else {
        targets_.push_back({{}, detections[d].code, bounds(detections[d].outline), frame.captured});
        detected(targets_.back(), detections[d], kept);
      }
    }
    return strangers;
  }

  void detected(Followed& target, const Sighting& seen, const std::shared_ptr<const Pursuit::Kept>& kept) {
    target.answer = seen;
    target.believed = true;
    target.detected = kept->captured;
    target.pursuit.restart(kept, bounds(seen.outline));
  }

  Sightings answers(const Frame& frame, Sightings all) {
    for (Followed& target : targets_) {
      if (target.started == frame.index) continue;
      target.lost = !target.believed;
      if (target.lost) continue;
      target.last = bounds(target.answer->outline);
      target.answer->track = target.id;
      all.push_back(*target.answer);
    }
    std::erase_if(targets_, [&](const Followed& f) {
      return !f.id && (f.lost || seconds(frame.captured - f.detected) > options_.patience_s);
    });
    return all;
  }

  std::unique_ptr<Detector> detector_;
  TrackerFactory make_tracker_;
  HybridOptions options_;
  std::vector<Followed> targets_;
  bool boxes_given_ = false;
  MotionMemory clock_;
  int since_look_ = 0;
  std::uint64_t starts_ = 0;
};

}  // namespace

std::unique_ptr<Method> hybrid(std::unique_ptr<Detector> detector, TrackerFactory make_tracker,
                               const HybridOptions& options) {
  return std::make_unique<Hybrid>(std::move(detector), std::move(make_tracker), options);
}

}  // namespace relock
