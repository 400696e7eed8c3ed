#pragma once

#include <memory>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"

namespace relock {

// OpenCV's own trackers, with the promises of trackers/checked_tracker.h. All of them work on whole pixels:
// the box is rounded when it is handed over and when it comes back.

/// Kernelized correlation filter (Henriques et al. 2015). It does not change the size of the box.
struct KcfOptions {
  double detect_thresh = 0.5;    ///< response below which the target is called lost
  double interp_factor = 0.075;  ///< how fast the model follows the target's looks, a part per frame
  bool resize = true;            ///< halve patches that are larger than max_patch_size
  int max_patch_size = 80 * 80;  ///< px^2
};

/// Discriminative correlation filter with channel and spatial reliability (Lukezic et al. 2017).
struct CsrtOptions {
  double psr_threshold = 0.035;   ///< peak-to-sidelobe ratio below which the target is called lost
  double template_size_px = 200;  ///< side to which the patch is scaled
  double padding = 3;             ///< search area, in sizes of the target
  double filter_lr = 0.02;        ///< how fast the filter follows the target's looks, a part per frame
  int number_of_scales = 33;      ///< sizes tried in each frame
  bool use_segmentation = true;   ///< weigh pixels by how much they look like target
};

/// Online multiple-instance learning (Babenko et al. 2009). It does not change the size of the box, never
/// calls the target lost, and draws at random from the clock: no two runs are the same.
struct MilOptions {
  double search_radius_px = 25;  ///< how far from the last place it looks
  int features = 250;            ///< Haar features drawn
};

std::vector<OptionInfo> kcf_option_list();
std::vector<OptionInfo> csrt_option_list();
std::vector<OptionInfo> mil_option_list();
// Each throws Error naming the option, the value and the legal range.
KcfOptions kcf_options(const Options& given);
CsrtOptions csrt_options(const Options& given);
MilOptions mil_options(const Options& given);

/// KCF and CSRT come with OpenCV's contributed modules: false where relock was built without them, and then
/// the two functions below throw Error.
bool has_contributed_trackers();
std::unique_ptr<Tracker> kcf_tracker(const KcfOptions& options);
std::unique_ptr<Tracker> csrt_tracker(const CsrtOptions& options);
std::unique_ptr<Tracker> mil_tracker(const MilOptions& options);

}  // namespace relock
