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
/// and scales.
///
/// Where the peak-to-sidelobe ratio falls below the threshold, it says lost. It goes on in the next frame from
/// where the weak peak was, as dlib does, since fast motion makes a peak weak that is in the right place. Only
/// when the box has changed its size by more than half by then, or most of it has left the picture, it starts
/// again from the last box that it said. It searches no further than about a fifth of the box around that, and
/// dlib learns the looks of lost frames, too: a target that is away for seconds is forgotten.
/// Confidence is p / (p + 7) of the peak-to-sidelobe ratio p: one half at 7.
std::unique_ptr<Tracker> dlib_tracker(const DlibOptions& options);

}  // namespace relock
