#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/random.h"
#include "sequences/simulator/material.h"
#include "sequences/simulator/painting.h"
#include "sequences/simulator/scene.h"

namespace relock::simulator {

/// The room's inside, axes along the world's.
struct Room {
  Eigen::Vector3d low;   ///< least x (left), y (ceiling), z (behind the camera at rest)
  Eigen::Vector3d high;  ///< greatest x (right), y (floor), z (the wall that is faced)
};

enum class Side : std::uint8_t { faced, left, right, behind, floor, ceiling };
constexpr int kSides = 6;

/// The room for an arrangement: 6 x 3 x 6 m, the targets' sheets 1 mm before the wall, or the box in its
/// middle.
Room room_for(const ScenePlan& plan);

/// A whole side of the room without its texture, visible from inside.
Surface side_of(const Room& room, Side side);

/// The part of a surface that covers `area` (m from its top left corner).
Surface part_of(const Surface& whole, const cv::Rect2d& area);
/// Width and height, m.
cv::Size2d extent(const Surface& surface);

/// What a side is made of and what stands and hangs there.
struct Decoration {
  Finish finish;
  cv::Rect2d window, radiator, door, shelf;  ///< m from the side's top left corner; without area: none
  std::uint64_t seed = 0;
};

/// Furnishes a side. `free`: nothing but the wall itself there, m.
Decoration decoration_of(Side side, const cv::Size2d& size, const std::optional<cv::Rect2d>& free,
                         Random random);

/// Paints what `canvas` shows of a side of `size` (m). `lamp`: its place on the ceiling.
void paint_side(Canvas& canvas, Side side, const cv::Size2d& size, const Decoration& decoration,
                const cv::Point2d& lamp);

}  // namespace relock::simulator
