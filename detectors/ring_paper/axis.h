#pragma once

#include <vector>

#include "detectors/ring_paper/clustering.h"
#include "detectors/ring_paper/components.h"

namespace relock::ring_paper {

/// The dominant direction of a cluster: the first principal component of the positions of all its pixels.
struct Axis {
  Vec2 mean;         ///< of the pixels
  Vec2 direction;    ///< of length 1, pointing right, or straight down
  Box box;           ///< around the cluster
  double reach = 0;  ///< standard deviation of the pixels along the direction, px
  double width = 0;  ///< across it, px
};
Axis principal_axis(const std::vector<Component>& parts, const Cluster& cluster);

/// Where the axis enters and leaves the cluster's box, widened by `margin_px`; in the order of its direction.
struct Segment {
  Vec2 from, to;
};
Segment through_box(const Axis& axis, double margin_px);

}  // namespace relock::ring_paper
