#include "trackers/legacy_tracker.h"

#include <fmt/format.h>

#include "core/error.h"

#if __has_include(<opencv2/tracking.hpp>) && __has_include(<opencv2/tracking/tracking_legacy.hpp>)
#define RELOCK_LEGACY_TRACKERS
// The second does not compile without the first.
// clang-format off
#include <opencv2/tracking.hpp>
#include <opencv2/tracking/tracking_legacy.hpp>
// clang-format on

#include <array>
#include <cstdlib>

#include "core/opencv.h"
#include "trackers/checked_tracker.h"
#include "trackers/start_box.h"
#endif

namespace relock {

std::vector<OptionInfo> medianflow_option_list() {
  const MedianFlowOptions d;
  return {{"points_in_grid", fmt::format("{}", d.points_in_grid), "", "points along each side of the box"},
          {"window_px", fmt::format("{}", d.window_px), "px", "side of the window of the optical flow"},
          {"levels", fmt::format("{}", d.levels), "", "halvings of the picture; more reach faster motion"},
          {"max_disagreement", fmt::format("{}", d.max_disagreement), "px",
           "median by which the points' motions may differ before the target is called lost"}};
}

MedianFlowOptions medianflow_options(const Options& given) {
  return {.points_in_grid = given.whole("points_in_grid", 3, 100),
          .window_px = given.whole("window_px", 3, 101),
          .levels = given.whole("levels", 0, 10),
          .max_disagreement = given.number("max_disagreement", 0, 1000)};
}

std::vector<OptionInfo> boosting_option_list() {
  const BoostingOptions d;
  return {{"classifiers", fmt::format("{}", d.classifiers), "", "in the strong classifier; more is slower"},
          {"search_factor", fmt::format("{}", d.search_factor), "target sizes",
           "side of the searched area; larger is slower"},
          {"first_iterations", fmt::format("{}", d.first_iterations), "",
           "of learning in the first frame; more is slower to start"}};
}

BoostingOptions boosting_options(const Options& given) {
  return {.classifiers = given.whole("classifiers", 10, 1000),
          .search_factor = given.number("search_factor", 1.2, 5),
          .first_iterations = given.whole("first_iterations", 1, 200)};
}

#ifdef RELOCK_LEGACY_TRACKERS
namespace {

using LibraryTracker = cv::Ptr<cv::legacy::Tracker>;

// Not cv::legacy::upgradeTrackingAPI: it loses what init() says, and rounds.
class LegacyFollower : public Follower {
 public:
  explicit LegacyFollower(LibraryTracker library) : library_(std::move(library)) {}

  void start(const Image& picture, const Box& box) override { start_at(picture, sub_pixel_rect(box)); }

  std::optional<Sighting> follow(const Image& picture) override {
    cv::Rect2d rect;
    if (!library_->update(bgr_copy(picture, bgr_), rect)) return std::nullopt;
    return sighting_of(sub_pixel_box(rect));
  }

 protected:
  void start_at(const Image& picture, const cv::Rect2d& rect) {
    if (!library_->init(bgr_copy(picture, bgr_), rect)) throw Error("OpenCV refuses to start on this box");
  }

 private:
  LibraryTracker library_;
  cv::Mat bgr_;
};

/// A sequence of rand() of its own, from the same seed every time, in use between take() and give_back().
class OwnRand {
 public:
#ifdef __GLIBC__
  OwnRand() { setstate(initstate(1, state_.data(), state_.size())); }
  void take() { before_ = setstate(state_.data()); }
  void give_back() { setstate(before_); }

 private:
  std::array<char, 128> state_;
  char* before_ = nullptr;
#else
  void take() {}
  void give_back() {}
#endif
};

class BoostingFollower final : public LegacyFollower {
 public:
  using LegacyFollower::LegacyFollower;

  void start(const Image& picture, const Box& box) override {
    const Turn turn(rand_);
    // With parts of a pixel in its size, OpenCV 4.6's boosting reads beyond its tables and crashes.
    start_at(picture, whole_pixels(box, picture.size()));
  }
  std::optional<Sighting> follow(const Image& picture) override {
    const Turn turn(rand_);
    return LegacyFollower::follow(picture);
  }

 private:
  struct Turn {
    explicit Turn(OwnRand& r) : rand(r) { rand.take(); }
    ~Turn() { rand.give_back(); }
    OwnRand& rand;
  };
  OwnRand rand_;
};

}  // namespace

bool has_legacy_trackers() { return true; }

std::unique_ptr<Tracker> mosse_tracker() {
  return checked_tracker("mosse",
                         [] { return std::make_unique<LegacyFollower>(cv::legacy::TrackerMOSSE::create()); });
}

std::unique_ptr<Tracker> medianflow_tracker(const MedianFlowOptions& options) {
  return checked_tracker("medianflow", [&] {
    cv::legacy::TrackerMedianFlow::Params p;
    p.pointsInGrid = options.points_in_grid;
    p.winSize = {options.window_px, options.window_px};
    p.maxLevel = options.levels;
    p.maxMedianLengthOfDisplacementDifference = options.max_disagreement;
    return std::make_unique<LegacyFollower>(cv::legacy::TrackerMedianFlow::create(p));
  });
}

std::unique_ptr<Tracker> tld_tracker() {
  return checked_tracker("tld",
                         [] { return std::make_unique<LegacyFollower>(cv::legacy::TrackerTLD::create()); });
}

std::unique_ptr<Tracker> boosting_tracker(const BoostingOptions& options) {
  return checked_tracker("boosting", [&] {
    cv::legacy::TrackerBoosting::Params p;
    p.numClassifiers = options.classifiers;
    p.samplerSearchFactor = static_cast<float>(options.search_factor);
    p.iterationInit = options.first_iterations;
    return std::make_unique<BoostingFollower>(cv::legacy::TrackerBoosting::create(p));
  });
}

#else

namespace {
[[noreturn]] std::unique_ptr<Tracker> missing(const char* name) {
  throw Error(fmt::format("{} needs OpenCV's contributed modules; this relock was built without them", name));
}
}  // namespace

bool has_legacy_trackers() { return false; }
std::unique_ptr<Tracker> mosse_tracker() { missing("mosse"); }
std::unique_ptr<Tracker> medianflow_tracker(const MedianFlowOptions&) { missing("medianflow"); }
std::unique_ptr<Tracker> tld_tracker() { missing("tld"); }
std::unique_ptr<Tracker> boosting_tracker(const BoostingOptions&) { missing("boosting"); }

#endif

}  // namespace relock
