#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "detectors/ring/candidates.h"
#include "detectors/ring/view.h"

namespace relock::ring {

// What chords tell of a view is not all of it: how the marker is foreshortened along the blur, how long the blur is
// and where along it the middle lies are guesses. These are the guesses from which a fit may start, px of the full
// picture; a fit comes home from half a ring away.

/// Direction of the blur as the picture's gradients about a candidate show it.
struct LocalBlur {
  Eigen::Vector2d direction{1, 0};
  double coherence = 0;  ///< 0: gradients of all directions, 1: of one only
};
// `chords`: all of the picture.

/// The first few: what the chords themselves say.
std::vector<View> plain_starts(const Candidate& candidate, const std::vector<Chord>& chords);
/// These and the others.
std::vector<View> starts(const Candidate& candidate, const std::vector<Chord>& chords,
                         const LocalBlur& local_blur, double focal_px);

/// From the gradients within `radius` of a point: blur leaves those across itself.
LocalBlur local_blur(const cv::Mat& gray, const Eigen::Vector2d& centre, double radius);

}  // namespace relock::ring
