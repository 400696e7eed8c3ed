#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry.h"

namespace relock::ring_paper {

/// Connected pixels above the threshold, with what later steps need of them.
struct Component {
  int label = 0;  ///< in Components::labels
  int area = 0;   ///< pixels
  cv::Rect box;
  Vec2 centroid;
  double xx = 0, xy = 0, yy = 0;  ///< sums over the pixels of the products about the centroid, px^2
};

struct Components {
  cv::Mat1i labels;  ///< of every pixel; those of components that were too small too
  std::vector<Component> parts;
};

/// The components (8-connected) of what is not 0 in `binary`, of `least_area` pixels or more. Of more than `most`
/// the largest ones. In the order in which they are met row by row.
Components connected_components(const cv::Mat1b& binary, int least_area, int most);

}  // namespace relock::ring_paper
