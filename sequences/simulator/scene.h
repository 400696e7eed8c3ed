#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/printed_target.h"
#include "sequences/simulator/texture.h"

// The world: metres, x to the right, y DOWN (gravity is +y), z away from the camera at rest, which looks along
// +z. The origin is in the middle of the main target, so the camera at rest is at (0, 0, -distance).

namespace relock::simulator {

/// A flat rectangle in the world, seen from the side on which `right` x `down` points away from the camera.
struct Surface {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  ///< top left corner, m
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  ///< the whole top edge, m
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();   ///< the whole left edge, m
  std::shared_ptr<const Texture> texture;            ///< stretched over it; its light is in it
  double gloss = 0;                                  ///< strength of the lamp's mirror image; 0: matt
  /// Where a thing that moves is at time t (s), as a shift of `corner`, m. Empty: it hangs still.
  std::function<Eigen::Vector3d(double)> shift = {};

  /// Its top left corner at time t.
  Eigen::Vector3d corner_at(double t) const { return shift ? corner + shift(t) : corner; }
  /// How far along `ray` from `eye`, in its lengths, the visible side is hit at time t; nothing: it is not.
  std::optional<double> hit(const Eigen::Vector3d& eye, const Eigen::Vector3d& ray, double t) const;
};

/// A target in the scene, and where.
struct HungTarget {
  PrintedTarget printed;
  std::string id;  ///< of the target in the labels: its printed name; "-2", "-3" … to a second of one name
  std::size_t surface = 0;  ///< in Scene::surfaces: its sheet
};

/// What there is to see. Later surfaces are in front of earlier ones wherever both are seen: room, posters,
/// boxes, sheets, then what hides them.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<HungTarget> targets;
  std::vector<std::size_t> occluders;        ///< in `surfaces`: what may hide targets
  Eigen::Vector3d lamp = {1.0, -1.6, -1.5};  ///< m
};

/// How targets are arranged.
enum class Arrangement : std::uint8_t {
  wall,  ///< on the wall that the camera faces: 1 to 3 side by side (the second right of the first, the third
         ///< left); from 4 on in two rows, the first above (four: the others right, below, and below right)
  box,   ///< one on each side of a box that stands free, up to four: front, right, back, left
  paper,  ///< the first in the middle, the others left and right of it: section 4.2 of the paper
};

struct ScenePlan {
  Arrangement arrangement = Arrangement::wall;
  double spacing_m = 0.45;   ///< wall and paper: between the middles of neighbours; 0.01 to 5
  double box_side_m = 0.45;  ///< box; 0.01 to 1.5
  double clutter = 0.5;      ///< 0 bare walls, 1 covered with what deceives fiducial detectors
  /// A picture for the wall that the camera faces, cut to 2 : 1 in its middle; nothing else hangs there then.
  std::optional<std::filesystem::path> background = {};
  double light_gradient = 0.3;  ///< 0 even light; 1: from full to none across the room
  double shadows = 0.3;         ///< how much light shadows take, 0 to 1
  double gloss = 0.0;           ///< of the sheets: strength of the specular spot; 0 to 100
  double occluders_hz = 0.0;    ///< how often something passes before each target, from 1 s on; 0 to 5
};

/// Throws Error on a quantity that is out of range.
void check_scene(const ScenePlan& plan);

/// Builds a room around the targets: 6 x 3 x 6 m, the floor 1.3 m below the main target. Around it the camera may
/// stand 0.3 to 4 m from the wall, or anywhere up to 2.5 m from the box. White paper in full light is 0.81.
/// Deterministic in `seed`. Throws Error on a background that is no picture, a number outside its range, no
/// target, more of them than the arrangement has places for (box: 4, paper: 3), and sheets that overlap or do
/// not fit.
Scene build_scene(const ScenePlan& plan, const std::vector<PrintedTarget>& targets, std::uint64_t seed);

}  // namespace relock::simulator
