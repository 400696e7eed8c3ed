#pragma once

#include <memory>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"

namespace relock {

struct FlowOptions {
  int features = 100;       ///< corners followed at most
  int window_px = 21;       ///< side of the window that is compared around each
  int levels = 3;           ///< halvings of the picture, for fast motion
  double return_px = 1;     ///< how far from its start a corner may come back when it is followed backwards
  double agreement_px = 1;  ///< how far from the common motion a corner may be to agree with it
  int least_inliers = 8;    ///< corners that must agree, or the target is called lost
};
std::vector<OptionInfo> flow_option_list();
/// Throws Error naming the option, the value and the legal range.
FlowOptions flow_options(const Options& given);

/// Follows corners in the box by pyramidal Lucas-Kanade flow (Bouguet 2000), keeps those that come back when
/// followed backwards, and moves the box by the similarity that most of them agree on (RANSAC).
///
/// It says an upright box around the moved centre, scaled, but not turned: labels and scores are of upright
/// boxes, and the upright box around a turned one is too large after every small error of the angle. New
/// corners are looked for when many were lost, in the inner 0.7 of the box's sides: its rim shows background.
///
/// It says lost when too few corners agree or most of the box has left the picture. After that it compares
/// each new frame with the last one in which it held the target, and so takes up again if the target is back
/// within reach of where it was; it does not search. `expect` is honoured: the next frame's search starts
/// from the prior's centre and size. How sure the prior is makes no difference. Confidence is the share of
/// the corners that agree.
std::unique_ptr<Tracker> flow_tracker(const FlowOptions& options);

}  // namespace relock
