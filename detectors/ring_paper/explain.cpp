#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "detectors/ring_paper/detector.h"

namespace relock::ring_paper {

std::vector<Stage> RingPaperDetector::explain(const Image& image, const std::optional<Box>& where) {
  detect(image, where);
  std::vector<Stage> stages;
  cv::Mat response;
  look_.response.convertTo(response, CV_8U, 255);
  stages.push_back({"filter", "the norm of the Gabor filters' outputs, white is the peak", response});
  return stages;
}

}  // namespace relock::ring_paper
