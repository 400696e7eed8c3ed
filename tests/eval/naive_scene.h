#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tests/eval/naive_parts.h"

// One frame and what can be asked of it: metrics.md section 3.
namespace relock::naive {

constexpr int kNobody = -1;

// One frame and all that is said of it.
struct Scene {
  const Recording& recording;
  const Trajectory& trajectory;
  const Gate& gate;
  std::size_t frame;
  const Sightings& sightings;

  std::size_t targets() const { return recording.targets.size(); }
  const Target& target(std::size_t t) const { return recording.targets[t]; }
  const TargetTruth& truth(std::size_t t) const { return recording.truth[frame * targets() + t]; }
  bool visible(std::size_t t) const { return truth(t).label == Label::visible; }
  bool absent(std::size_t t) const { return truth(t).label == Label::absent; }
  bool unlabelled(std::size_t t) const { return truth(t).label == Label::unlabelled; }
};

// --- What was asked of the method here.

inline bool not_started(const Scene& scene, std::size_t t) {
  const auto from = scene.trajectory.judged_from[t];
  const FrameReport& report = scene.trajectory.frames[scene.frame];
  const bool withheld = std::find(report.withheld.begin(), report.withheld.end(), t) != report.withheld.end();
  return withheld || !from || static_cast<FrameIndex>(scene.frame) < *from;
}
inline bool given(const Scene& scene, std::size_t t) {
  const auto& given = scene.trajectory.frames[scene.frame].given;
  return std::find(given.begin(), given.end(), t) != given.end();
}
inline bool given_or_not_started(const Scene& scene, std::size_t t) {
  return not_started(scene, t) || given(scene, t);
}
inline bool judged_here(const Scene& scene, std::size_t t) {
  return !given_or_not_started(scene, t) && !scene.unlabelled(t);
}

// --- One sighting and one target.

inline bool wrong_code(const Scene& scene, std::size_t t, std::size_t s) {
  const auto &read = scene.sightings[s].code, &written = scene.target(t).code;
  return read && written && *read != *written;
}
inline bool tracked(const Scene& scene, std::size_t s) { return scene.sightings[s].track.has_value(); }
inline bool tracks(const Scene& scene, std::size_t t, std::size_t s) {
  return scene.sightings[s].track == scene.target(t).id;
}
inline bool reads_code_of(const Scene& scene, std::size_t t, std::size_t s) {
  return scene.sightings[s].code && scene.sightings[s].code == scene.target(t).code;
}
inline bool claims(const Scene& scene, std::size_t t, std::size_t s) {
  return tracks(scene, t, s) || reads_code_of(scene, t, s);
}
inline bool claims_nobody(const Scene& scene, std::size_t s) {
  for (std::size_t t = 0; t < scene.targets(); ++t)
    if (claims(scene, t, s)) return false;
  return true;
}

inline double error_px(const Scene& scene, std::size_t t, std::size_t s) {
  const Sighting& sighting = scene.sightings[s];
  return distance(sighting.centre, matching_centre(scene.truth(t), sighting.centre_kind));
}
inline double iou(const Scene& scene, std::size_t t, std::size_t s) {
  return overlap(scene.sightings[s].outline, *scene.truth(t).outline);
}
inline bool within_gate(const Scene& scene, std::size_t t, std::size_t s, double limit) {
  if (scene.gate.measure == Gate::Measure::iou) return iou(scene, t, s) >= limit;
  return error_px(scene, t, s) <= limit * outline_size(*scene.truth(t).outline);
}
inline bool within_hold(const Scene& scene, std::size_t t, std::size_t s) {
  return within_gate(scene, t, s, scene.gate.hold);
}
inline bool would_hit(const Scene& scene, std::size_t t, std::size_t s) {
  return within_gate(scene, t, s, scene.gate.hit) && !wrong_code(scene, t, s);
}
inline bool may_be_matched(const Scene& scene, std::size_t t, std::size_t s) {
  return within_hold(scene, t, s) && (!tracked(scene, s) || tracks(scene, t, s));
}
// e / D, or 1 - IoU, in whole billionths, so that equal is equal.
inline long long cost(const Scene& scene, std::size_t t, std::size_t s) {
  const double plain = scene.gate.measure == Gate::Measure::iou
                           ? 1 - iou(scene, t, s)
                           : error_px(scene, t, s) / outline_size(*scene.truth(t).outline);
  return std::llround(plain * 1e9);
}

// --- Orders by position.

inline std::tuple<double, double, std::size_t> target_place(const Scene& scene, std::size_t t) {
  const Vec2 centre = outline_centre(*scene.truth(t).outline);
  return {centre.x, centre.y, t};
}
inline std::tuple<double, double, std::size_t> sighting_place(const Scene& scene, std::size_t s) {
  return {scene.sightings[s].centre.x, scene.sightings[s].centre.y, s};
}
inline std::vector<std::size_t> by_place(const Scene& scene, std::vector<std::size_t> targets) {
  std::sort(targets.begin(), targets.end(),
            [&](std::size_t a, std::size_t b) { return target_place(scene, a) < target_place(scene, b); });
  return targets;
}
// A wrong code last at one place.
inline std::vector<std::size_t> by_place_for(const Scene& scene, std::size_t t,
                                             std::vector<std::size_t> sightings) {
  const auto key = [&](std::size_t s) {
    return std::tuple(scene.sightings[s].centre.x, scene.sightings[s].centre.y, wrong_code(scene, t, s), s);
  };
  std::sort(sightings.begin(), sightings.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return sightings;
}

}  // namespace relock::naive
