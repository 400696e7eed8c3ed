#include "trackers/blut/occlusion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace relock::blut {

double occluded_share(const Eigen::Ref<const Eigen::VectorXf>& trivial, particles::Grid grid, double level) {
  // A look has length 1, so that its standard deviation is one over the root of the number of samples.
  const double least = level / std::sqrt(static_cast<double>(grid.size()));
  cv::Mat1b large(grid.rows, grid.columns);
  for (int i = 0; i < grid.size(); ++i)
    large(i / grid.columns, i % grid.columns) = std::abs(trivial[i]) > least ? 255 : 0;
  cv::morphologyEx(large, large, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  cv::Mat labels, statistics, centres;
  const int pieces = cv::connectedComponentsWithStats(large, labels, statistics, centres);
  int largest = 0;
  for (int piece = 1; piece < pieces; ++piece)  // 0 is what is explained
    largest = std::max(largest, statistics.at<int>(piece, cv::CC_STAT_AREA));
  return static_cast<double>(largest) / grid.size();
}

}  // namespace relock::blut
