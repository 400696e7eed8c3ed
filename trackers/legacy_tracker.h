#pragma once

#include <memory>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"

namespace relock {

// The trackers that OpenCV keeps in cv::legacy, part of its contributed modules. They have the promises of
// trackers/checked_tracker.h. The box goes in and comes back with its parts of a pixel, except for boosting
// and for mosse, which rounds its middle and makes it a little larger.

/// Forward-backward optical flow on a grid of points (Kalal et al. 2010). The box scales. It says lost when
/// the points disagree, and is taken in by the background once the target has left the picture.
struct MedianFlowOptions {
  int points_in_grid = 10;       ///< points along each side of the box
  int window_px = 3;             ///< side of the window of the optical flow
  int levels = 5;                ///< halvings of the picture, for fast motion
  double max_disagreement = 10;  ///< px; median by which the points' motions may differ
};

/// Online AdaBoost (Grabner et al. 2006). Whole pixels; the box keeps its size; it never says lost. One
/// tracker takes about 200 MB and a quarter of a second to start. The library draws from rand(): relock keeps
/// a sequence of its own for every start where the C library is glibc, so that a start is repeatable and the
/// program's rand() stays undisturbed. Elsewhere trackers at work side by side change each other's answers.
struct BoostingOptions {
  int classifiers = 100;       ///< in the strong classifier; more is slower
  double search_factor = 1.8;  ///< side of the searched area, in sizes of the target
  int first_iterations = 50;   ///< of learning in the first frame
};

std::vector<OptionInfo> medianflow_option_list();
std::vector<OptionInfo> boosting_option_list();
// Each throws Error naming the option, the value and the legal range.
MedianFlowOptions medianflow_options(const Options& given);
BoostingOptions boosting_options(const Options& given);

/// Whether relock was built with cv::legacy; if not, the functions below throw Error.
bool has_legacy_trackers();

/// Minimum output sum of squared error filter (Bolme et al. 2010). The box keeps its size: the start box's
/// sides, made larger to the next product of twos, threes and fives. After saying lost it goes on looking
/// around the last place.
std::unique_ptr<Tracker> mosse_tracker();
std::unique_ptr<Tracker> medianflow_tracker(const MedianFlowOptions& options);
/// Tracking, learning, detection (Kalal et al. 2012): median flow with a detector that is learnt on the way
/// and searches the whole picture. The box scales. Slow, and seeded from the clock: no two runs are the same.
std::unique_ptr<Tracker> tld_tracker();
std::unique_ptr<Tracker> boosting_tracker(const BoostingOptions& options);

}  // namespace relock
