#include "core/compose.h"

#include <map>
#include <utility>

namespace relock {
namespace {

class DetectEveryFrame final : public Method {
 public:
  explicit DetectEveryFrame(std::unique_ptr<Detector> detector) : detector_(std::move(detector)) {}

  bool takes_boxes() const override { return false; }
  void start(const Frame&, const Target&, const Box&) override {}
  Sightings locate(const Frame& frame) override { return detector_->detect(frame.image); }

 private:
  std::unique_ptr<Detector> detector_;
};

class TrackFromBox final : public Method {
 public:
  explicit TrackFromBox(TrackerFactory make_tracker) : make_tracker_(std::move(make_tracker)) {}

  bool takes_boxes() const override { return true; }

  void start(const Frame& frame, const Target& target, const Box& box) override {
    following_.erase(target.id);  // a start that fails must not leave the old tracker running
    auto tracker = make_tracker_(starts_++);
    tracker->start(frame, box);
    following_[target.id] = Following{std::move(tracker), frame.index};
  }

  Sightings locate(const Frame& frame) override {
    Sightings found;
    for (auto& [id, following] : following_) {
      if (following.started == frame.index) continue;
      if (auto sighting = following.tracker->track(frame)) {
        sighting->track = id;
        found.push_back(std::move(*sighting));
      }
    }
    return found;
  }

 private:
  struct Following {
    std::unique_ptr<Tracker> tracker;
    FrameIndex started = 0;
  };

  TrackerFactory make_tracker_;
  std::uint64_t starts_ = 0;
  std::map<TargetId, Following> following_;
};

}  // namespace

std::unique_ptr<Method> detect_every_frame(std::unique_ptr<Detector> detector) {
  return std::make_unique<DetectEveryFrame>(std::move(detector));
}

std::unique_ptr<Method> track_from_box(TrackerFactory make_tracker) {
  return std::make_unique<TrackFromBox>(std::move(make_tracker));
}

}  // namespace relock
