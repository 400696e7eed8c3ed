#pragma once

#include <memory>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"

namespace relock {

struct DlibOptions {
  double psr_threshold = 7;  ///< peak-to-sidelobe ratio below which the target is called lost
  int filter_size = 6;       ///< the filter is 2 to this power px wide and high
  int num_scale_levels = 5;  ///< 2 to this power sizes are tried in each frame
};
std::vector<OptionInfo> dlib_option_list();
/// Throws Error naming the option, the value and the legal range.
DlibOptions dlib_options(const Options& given);

/// Whether relock was built with dlib; if not, dlib_tracker throws Error.
bool has_dlib();

/// dlib's correlation_tracker on the grey picture (Danelljan et al. 2014): the box moves by parts of a pixel
/// and scales. dlib finds the peak to about one pixel of its filter, which is 1/45 of the box by default.
///
/// Where the peak-to-sidelobe ratio falls below the threshold, it says lost. Down to half of it, it goes on
/// in the next frame from where the weak peak was, as dlib does: fast motion makes peaks weak that are in the
/// right place. Below that, or when the box has left the picture or changed its size by more than half, it
/// searches around the last box that it said: about a fifth of the box to each side. dlib learns the looks of
/// lost frames, too, so a target that is away for seconds is forgotten. Confidence is p / (p + 7) of the
/// peak-to-sidelobe ratio p: one half at 7.
std::unique_ptr<Tracker> dlib_tracker(const DlibOptions& options);

}  // namespace relock
