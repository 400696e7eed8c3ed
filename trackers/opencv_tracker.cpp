#include "trackers/opencv_tracker.h"

#include <fmt/format.h>

#include <functional>
#include <opencv2/video/tracking.hpp>
#include <string>

#include "core/error.h"
#include "core/opencv.h"
#include "trackers/start_box.h"

#if __has_include(<opencv2/tracking.hpp>)
#define RELOCK_CONTRIBUTED_TRACKERS
#include <opencv2/tracking.hpp>
#endif

namespace relock {
namespace {

using LibraryTracker = cv::Ptr<cv::Tracker>;

/// Calls the library; what it throws becomes one sentence about `tracker`. Not only cv::Exception: MIL throws
/// std::bad_alloc.
template <class Call>
auto guarded(const std::string& tracker, const char* doing, const Call& call) {
  try {
    return call();
  } catch (const cv::Exception& fault) {
    throw Error(fmt::format("{} could not {}: OpenCV says \"{}\"", tracker, doing, fault.err));
  } catch (const std::exception& fault) {
    throw Error(fmt::format("{} could not {}: the library says \"{}\"", tracker, doing, fault.what()));
  }
}

class OpencvTracker final : public Tracker {
 public:
  OpencvTracker(std::string name, const std::function<LibraryTracker()>& make)
      : name_(std::move(name)), library_(guarded(name_, "be made", make)) {}

  void start(const Frame& frame, const Box& box) override {
    // A second init() on one KCF of OpenCV 4.6 corrupts memory.
    if (state_ != State::fresh)
      throw Error(fmt::format("{} was started already; a restart takes a new object", name_));
    const cv::Rect rect = rounded_rect(startable_box(name_, frame.image, box));
    size_ = frame.image.size();
    state_ = State::failed;
    guarded(name_, "start", [&] { library_->init(own_copy(frame), rect); });
    state_ = State::running;
  }

  std::optional<Sighting> track(const Frame& frame) override {
    check_running(frame);
    cv::Rect rect;
    state_ = State::failed;
    const bool seen = guarded(name_, "go on", [&] { return library_->update(own_copy(frame), rect); });
    state_ = State::running;
    const Box box = box_of(rect);
    // The library may call a box found that is empty or lies outside of the picture.
    if (!seen || !well_formed(box) || intersect(box, picture_box(size_)).area() <= 0) return std::nullopt;
    return sighting_of(box);
  }

 private:
  enum class State { fresh, running, failed };

  void check_running(const Frame& frame) const {
    // OpenCV's update() before init() is a segmentation fault.
    if (state_ == State::fresh) throw Error(fmt::format("{} was given a frame before it was started", name_));
    if (state_ == State::failed) throw Error(fmt::format("{} has failed and takes no more frames", name_));
    const Size size = frame.image.size();
    if (frame.image.empty()) throw Error(fmt::format("{} was given an empty picture", name_));
    if (size != size_)
      throw Error(fmt::format("{} was started on pictures of {} x {} px and given one of {} x {} px", name_,
                              size_.width, size_.height, size.width, size.height));
  }

  /// The trackers want BGR throughout, and some write into what they are given.
  const cv::Mat& own_copy(const Frame& frame) { return bgr_copy(frame.image, bgr_); }

  std::string name_;
  LibraryTracker library_;
  State state_ = State::fresh;
  Size size_;
  cv::Mat bgr_;
};

}  // namespace

#ifdef RELOCK_CONTRIBUTED_TRACKERS

bool has_contributed_trackers() { return true; }

std::unique_ptr<Tracker> kcf_tracker(const KcfOptions& options) {
  return std::make_unique<OpencvTracker>("kcf", [&]() -> LibraryTracker {
    cv::TrackerKCF::Params p;
    p.detect_thresh = static_cast<float>(options.detect_thresh);
    p.interp_factor = static_cast<float>(options.interp_factor);
    p.resize = options.resize;
    p.max_patch_size = options.max_patch_size;
    return cv::TrackerKCF::create(p);
  });
}

std::unique_ptr<Tracker> csrt_tracker(const CsrtOptions& options) {
  return std::make_unique<OpencvTracker>("csrt", [&]() -> LibraryTracker {
    cv::TrackerCSRT::Params p;
    p.psr_threshold = static_cast<float>(options.psr_threshold);
    p.template_size = static_cast<float>(options.template_size_px);
    p.padding = static_cast<float>(options.padding);
    p.filter_lr = static_cast<float>(options.filter_lr);
    p.number_of_scales = options.number_of_scales;
    p.use_segmentation = options.use_segmentation;
    return cv::TrackerCSRT::create(p);
  });
}

#else

bool has_contributed_trackers() { return false; }

std::unique_ptr<Tracker> kcf_tracker(const KcfOptions&) {
  throw Error("kcf needs OpenCV's contributed modules, without which relock was built");
}
std::unique_ptr<Tracker> csrt_tracker(const CsrtOptions&) {
  throw Error("csrt needs OpenCV's contributed modules, without which relock was built");
}

#endif

std::unique_ptr<Tracker> mil_tracker(const MilOptions& options) {
  return std::make_unique<OpencvTracker>("mil", [&]() -> LibraryTracker {
    cv::TrackerMIL::Params p;
    p.samplerSearchWinSize = static_cast<float>(options.search_radius_px);
    p.featureSetNumFeatures = options.features;
    return cv::TrackerMIL::create(p);
  });
}

}  // namespace relock
