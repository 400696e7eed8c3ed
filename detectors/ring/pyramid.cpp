#include "detectors/ring/pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace relock::ring {

void Pyramid::build(const cv::Mat& picture) {
  level[0] = picture;
  for (std::size_t k = 1; k < kLevels; ++k) {
    const cv::Mat& finer = level[k - 1];
    // An odd last row or column is left out: the others keep their exact places.
    const cv::Size size{finer.cols / 2, finer.rows / 2};
    if (size.empty()) {
      level[k].release();
      continue;
    }
    cv::resize(finer(cv::Rect({}, cv::Size(2 * size.width, 2 * size.height))), level[k], size, 0, 0,
               cv::INTER_AREA);
  }
}

}  // namespace relock::ring
