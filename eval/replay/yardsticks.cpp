#include "eval/replay/yardsticks.h"

#include <map>

namespace relock {
namespace {

class Mute final : public Method {
 public:
  bool takes_boxes() const override { return true; }
  void start(const Frame&, const Target&, const Box&) override {}
  Sightings locate(const Frame&) override { return {}; }
};

class Oracle final : public Method {
 public:
  explicit Oracle(const Recording& recording) : recording_(recording) {}

  bool takes_boxes() const override { return true; }
  void start(const Frame& frame, const Target& target, const Box&) override {
    started_[target.id] = frame.index;
  }

  Sightings locate(const Frame& frame) override {
    Sightings all;
    for (std::size_t t = 0; t < recording_.targets.size(); ++t) {
      const Target& target = recording_.targets[t];
      const TargetTruth& truth = recording_.truth_of(static_cast<std::size_t>(frame.index), t);
      const auto started = started_.find(target.id);
      if (truth.label != Label::visible || (started != started_.end() && started->second == frame.index))
        continue;
      Sighting seen = sighting_of(*truth.outline);
      if (truth.centre_projected)
        seen.centre = *truth.centre_projected, seen.centre_kind = CentreKind::projected;
      seen.code = target.code;
      seen.track = target.id;
      all.push_back(seen);
    }
    return all;
  }

 private:
  const Recording& recording_;
  std::map<TargetId, FrameIndex> started_;
};

}  // namespace

std::unique_ptr<Method> mute() { return std::make_unique<Mute>(); }
std::unique_ptr<Method> oracle(const Recording& recording) { return std::make_unique<Oracle>(recording); }

}  // namespace relock
