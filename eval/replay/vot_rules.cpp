#include "eval/replay/vot_rules.h"

#include <algorithm>

namespace relock {
namespace {

/// Outlines that only touch may seem to share less than this part, by rounding.
constexpr double kRounding = 1e-9;

bool contains(const std::vector<std::size_t>& targets, std::size_t target) {
  return std::binary_search(targets.begin(), targets.end(), target);
}

}  // namespace

bool misses_by_vot(const Recording& recording, std::size_t frame, std::size_t target,
                   const FrameReport& report) {
  const TargetTruth& truth = recording.truth_of(frame, target);
  if (truth.label != Label::visible) return false;
  const auto overlaps = [&](const Sighting& sighting) {
    if (sighting.track && *sighting.track != recording.targets[target].id) return false;
    const Box seen = intersect(bounds(sighting.outline), picture_box(recording.picture));
    return seen.area() > 0 && share_inside(*truth.outline, seen) > kRounding;
  };
  return std::none_of(report.sightings.begin(), report.sightings.end(), overlaps);
}

std::vector<VotFrame> vot_frames(const Recording& recording, const Trajectory& trajectory,
                                 std::size_t target) {
  std::vector<VotFrame> all;
  bool running = false;
  for (std::size_t frame = 0; frame < trajectory.frames.size(); ++frame) {
    const FrameReport& report = trajectory.frames[frame];
    if (contains(report.given, target)) {
      running = true;
      all.push_back(VotFrame::start);
    } else if (!running) {
      all.push_back(VotFrame::outside);
    } else if (report.delivery != Delivery::delivered ||
               recording.truth_of(frame, target).label != Label::visible) {
      all.push_back(VotFrame::unjudged);
    } else {
      running = !misses_by_vot(recording, frame, target, report);
      all.push_back(running ? VotFrame::tracked : VotFrame::failure);
    }
  }
  return all;
}

}  // namespace relock
