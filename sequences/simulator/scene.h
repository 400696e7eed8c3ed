#pragma once

#include <Eigen/Core>
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
};

/// A target in the scene, and where.
struct HungTarget {
  PrintedTarget printed;
  std::string id;           ///< of the target in the labels
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
  wall,   ///< side by side on the wall that the camera faces; four make two rows of two
  box,    ///< one on each side of a box that stands free, up to four
  paper,  ///< the first in the middle, the others left and right of it: section 4.2 of the paper
};

struct ScenePlan {
  Arrangement arrangement = Arrangement::wall;
  double spacing_m = 0.45;   ///< wall and paper: between the middles of neighbours
  double box_side_m = 0.45;  ///< box
  double clutter = 0.5;      ///< 0 bare walls, 1 covered with what deceives fiducial detectors
  std::optional<std::filesystem::path> background = {};  ///< a picture for the wall that the camera faces
  double light_gradient = 0.3;  ///< 0 even light; 1: from full to none across the room
  double shadows = 0.3;         ///< how much light shadows take, 0 to 1
  double gloss = 0.0;           ///< of the sheets: strength of the specular spot
  double occluders_hz = 0.0;    ///< how often something passes before a target
};

/// Builds a room around the targets. Deterministic in `seed`. Throws Error on a background that is no picture,
/// on no target, or more of them than the arrangement has places for (box: 4, paper: 3).
Scene build_scene(const ScenePlan& plan, const std::vector<PrintedTarget>& targets, std::uint64_t seed);

}  // namespace relock::simulator
