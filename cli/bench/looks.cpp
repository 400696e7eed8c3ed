#include "cli/bench/looks.h"

#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

#include "cli/in_parallel.h"
#include "cli/judged_picture.h"
#include "core/opencv.h"
#include "detectors/pose/pose.h"

namespace relock::bench {
namespace {

/// From the name of a kind, so that no two kinds share places and backdrops, whatever else is measured with them.
std::uint64_t seed_of(const std::string& name, Seeds seeds) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211U;
  return (hash & ~std::uint64_t{1}) + (seeds == Seeds::odd ? 1 : 0);
}

pose::Camera camera_of(const simulator::Camera& camera) {
  const Vec2 middle = camera.middle();
  return {camera.picture, camera.focal_px, camera.focal_px, middle.x, middle.y, {camera.k1, camera.k2}};
}

/// Of the likeliest pose.
void judge_pose(const MadePicture& picture, const pose::Camera& camera, double size_m,
                const Sighting& sighting, Look& look) {
  const auto poses = pose::pose_of(camera, sighting, size_m);
  if (poses.empty()) return;
  const Eigen::Vector3d truth = -picture.pose->normal(), &found = poses.front().normal;
  const double depth = picture.pose->position.z();
  look.depth_percent = 100 * std::abs(poses.front().position.z() - depth) / depth;
  look.normal_deg = 180 / std::numbers::pi * std::atan2(truth.cross(found).norm(), truth.dot(found));
}

}  // namespace

PictureKind stills(const std::string& name, const simulator::StillPlan& plan,
                   const std::vector<PrintedTarget>& targets, Seeds seeds) {
  simulator::check_stills(plan);
  return {name, targets,
          [=, seed = seed_of(name, seeds)](std::size_t rank) {
            const simulator::Still still = simulator::still(plan, targets, rank, seed);
            MadePicture made{still.pixels, still.shown};
            if (still.shown) made.truth = still.targets[*still.shown], made.pose = still.pose;
            return made;
          },
          camera_of(plan.camera())};
}

PictureKind canvas(const std::string& name, double marker_px, double blur_px,
                   const std::vector<PrintedTarget>& targets, Seeds seeds) {
  simulator::CanvasPlan plan;
  plan.marker_px = marker_px;
  plan.lengths_px = {blur_px};
  plan.angles_deg.clear();
  for (int angle = 0; angle < 180; angle += 5) plan.angles_deg.push_back(angle);
  simulator::check_canvas(plan);
  return {name, targets, [=, seed = seed_of(name, seeds)](std::size_t rank) {
            const std::size_t target = rank % targets.size(), place = rank / targets.size();
            // A quarter turn apart, so that a few pictures have all sorts of directions.
            const std::size_t angle = place * 7 % plan.angles_deg.size();
            const auto picture = simulator::canvas_picture(plan, targets[target], angle, seed + 2 * rank);
            return MadePicture{picture.pixels, target, picture.truth};
          }};
}

Look judged(const MadePicture& picture, const PictureKind& kind, const Sightings& sightings) {
  Look look;
  look.wrong = static_cast<int>(sightings.size());
  if (!picture.shown) return look;
  const PrintedTarget& target = kind.targets[*picture.shown];
  const FrameJudgement frame = judged_alone(
      one_frame(picture.pixels, {{target.name, target.code, target.size_m}}, {picture.truth}), sightings);
  const Judgement& judgement = frame.targets.front();
  look.recognised = judgement.verdict == Verdict::Hit && !judgement.uncoded;
  if (!look.recognised) return look;
  --look.wrong;
  const Sighting& sighting = sightings[static_cast<std::size_t>(judgement.sighting)];
  look.centre_px = norm(sighting.centre - picture.truth.centre(sighting.centre_kind));
  if (picture.pose && kind.camera) judge_pose(picture, *kind.camera, target.size_m, sighting, look);
  const Vec2 blur = picture.truth.blur.value_or(Vec2{});
  if (const double length = norm(blur); length > 0 && sighting.blur) {
    look.direction_deg =
        180 / std::numbers::pi * between_axes(sighting.blur->direction_rad, std::atan2(blur.y, blur.x));
    look.length_percent = 100 * std::abs(sighting.blur->length_px - length) / length;
  }
  return look;
}

std::vector<Look> look_at(const PictureKind& kind, std::size_t count, int jobs,
                          const std::function<std::unique_ptr<Detector>()>& make_detector,
                          const std::function<void()>& looked) {
  std::vector<Look> looks(count);
  std::mutex telling;
  in_parallel(count, jobs, [&] {
    return [&, detector = std::shared_ptr<Detector>(make_detector())](std::size_t rank) {
      const MadePicture picture = kind.make(rank);
      looks[rank] = judged(picture, kind, detector->detect(view(picture.pixels)));
      const std::lock_guard lock(telling);
      looked();
    };
  });
  return looks;
}

}  // namespace relock::bench
