#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/random.h"
#include "sequences/simulator/room.h"
#include "sequences/simulator/scene.h"

namespace relock::simulator {

/// The light that falls on a place: even, less with distance from the lamp and across the room, and taken by
/// corners and by what stands before the lamp. A function of place and direction alone, so it runs on from a
/// wall to a sheet on it. Exposed so that full light is `kFull`: white paper there is a little above 0.8.
class Light {
 public:
  static constexpr double kFull = 0.95;

  /// Shadows fall at and around `lit`, the targets' middles.
  Light(const ScenePlan& plan, const Room& room, const Eigen::Vector3d& lamp,
        const std::vector<Eigen::Vector3d>& lit, Random random);

  /// At a place (m) of something that faces `outward` (length 1).
  double at(const Eigen::Vector3d& place, const Eigen::Vector3d& outward) const;
  /// Over a surface, one value for each `cell_m`: CV_32FC1.
  cv::Mat over(const Surface& surface, double cell_m) const;

 private:
  // A rod with round ends that stands in the light. Nobody sees it: it may be a lamp's frame or a passer-by.
  struct Rod {
    Eigen::Vector3d from, to;
    double radius;
  };

  double let_through(const Eigen::Vector3d& place) const;
  double corners(const Eigen::Vector3d& place) const;

  double gradient_, shadows_;
  Room room_;
  Eigen::Vector3d lamp_;
  std::vector<Rod> rods_;
};

/// Which way the visible side of a surface faces, length 1.
Eigen::Vector3d outward(const Surface& surface);

}  // namespace relock::simulator
