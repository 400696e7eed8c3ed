#include "trackers/opencv_tracker.h"

#include "core/error.h"
#include "trackers/opencv_follower.h"

#if __has_include(<opencv2/tracking.hpp>)
#define RELOCK_CONTRIBUTED_TRACKERS
#include <opencv2/tracking.hpp>
#endif

namespace relock {
namespace {

using WholePixelFollower = OpencvFollower<cv::Tracker>;

}  // namespace

#ifdef RELOCK_CONTRIBUTED_TRACKERS

bool has_contributed_trackers() { return true; }

std::unique_ptr<Tracker> kcf_tracker(const KcfOptions& options) {
  return checked_tracker("kcf", [&] {
    cv::TrackerKCF::Params p;
    p.detect_thresh = static_cast<float>(options.detect_thresh);
    p.interp_factor = static_cast<float>(options.interp_factor);
    p.resize = options.resize;
    p.max_patch_size = options.max_patch_size;
    return std::make_unique<WholePixelFollower>(cv::TrackerKCF::create(p));
  });
}

std::unique_ptr<Tracker> csrt_tracker(const CsrtOptions& options) {
  return checked_tracker("csrt", [&] {
    cv::TrackerCSRT::Params p;
    p.psr_threshold = static_cast<float>(options.psr_threshold);
    p.template_size = static_cast<float>(options.template_size_px);
    p.padding = static_cast<float>(options.padding);
    p.filter_lr = static_cast<float>(options.filter_lr);
    p.number_of_scales = options.number_of_scales;
    p.use_segmentation = options.use_segmentation;
    return std::make_unique<WholePixelFollower>(cv::TrackerCSRT::create(p));
  });
}

#else

bool has_contributed_trackers() { return false; }

std::unique_ptr<Tracker> kcf_tracker(const KcfOptions&) {
  throw Error("kcf needs OpenCV's contributed modules; this relock was built without them");
}
std::unique_ptr<Tracker> csrt_tracker(const CsrtOptions&) {
  throw Error("csrt needs OpenCV's contributed modules; this relock was built without them");
}

#endif

std::unique_ptr<Tracker> mil_tracker(const MilOptions& options) {
  return checked_tracker("mil", [&] {
    cv::TrackerMIL::Params p;
    p.samplerSearchWinSize = static_cast<float>(options.search_radius_px);
    p.featureSetNumFeatures = options.features;
    return std::make_unique<WholePixelFollower>(cv::TrackerMIL::create(p));
  });
}

}  // namespace relock
