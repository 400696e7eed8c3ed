#include "trackers/yardsticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/opencv.h"
#include "trackers/patch_match.h"

namespace relock {
namespace {

/// What both yardsticks do with their start.
class StartBox {
 public:
  void set(const char* name, const Image& picture, const Box& box) {
    if (box_) throw Error(fmt::format("{} was started already; a restart takes a new object", name));
    if (!well_formed(box))
      throw Error(fmt::format("{} needs a start box of finite numbers and sides above zero", name));
    if (intersect(box, picture_box(picture.size())).area() <= 0)
      throw Error(fmt::format("{} needs a start box that touches the picture", name));
    box_ = box;
  }
  const Box& get(const char* name) const {
    if (!box_) throw Error(fmt::format("{} was given a frame before it was started", name));
    return *box_;
  }

 private:
  std::optional<Box> box_;
};

class StillTracker final : public Tracker {
 public:
  void start(const Frame& frame, const Box& box) override { box_.set("still", frame.image, box); }
  std::optional<Sighting> track(const Frame& frame) override {
    const Box& box = box_.get("still");
    if (frame.image.empty()) throw Error("still was given an empty picture");
    return sighting_of(box);
  }

 private:
  StartBox box_;
};

/// The pixels that a patch covers when it is moved by up to `reach` px in x and y from where its top left
/// pixel is `expected`. That may be huge or far away: clipped while still double.
cv::Rect window_around(Vec2 expected, cv::Size patch, int reach, cv::Size picture) {
  const double left = std::max(0.0, std::round(expected.x) - reach),
               top = std::max(0.0, std::round(expected.y) - reach);
  const double right = std::min<double>(picture.width, std::round(expected.x) + patch.width + reach);
  const double bottom = std::min<double>(picture.height, std::round(expected.y) + patch.height + reach);
  if (!(right > left && bottom > top)) return {};
  return {static_cast<int>(left), static_cast<int>(top), static_cast<int>(right - left),
          static_cast<int>(bottom - top)};
}

class LinearTracker final : public Tracker {
 public:
  explicit LinearTracker(const LinearOptions& options) : frames_left_(options.frames) {}

  void start(const Frame& frame, const Box& box) override {
    box_.set("linear", frame.image, box);
    started_ = frame.captured;
    picture_ = picture_box(frame.image.size());
    const Box inside = intersect(box, picture_);
    if (inside.width < kLeastPatchPx || inside.height < kLeastPatchPx) return;
    const cv::Mat gray = gray_of(frame.image, gray_);
    const cv::Rect place = rounded_rect(inside) & cv::Rect({}, gray.size());
    patch_.set(gray, place);
    patch_at_ = {static_cast<double>(place.x), static_cast<double>(place.y)};
    // Measured like all later places, so that what the parabola does wrong on this texture cancels.
    if (const auto match = find(gray, patch_at_, 2)) patch_at_ = match->corner;
  }

  std::optional<Sighting> track(const Frame& frame) override {
    Box box = box_.get("linear");
    if (frame.image.empty()) throw Error("linear was given an empty picture");
    const double t = seconds(frame.captured - started_);
    if (frames_left_ > 0) {
      --frames_left_;
      measure(frame, t);
    }
    box.x += velocity_.x * t;
    box.y += velocity_.y * t;
    if (intersect(box, picture_).area() <= 0) return std::nullopt;
    return sighting_of(box);
  }

 private:
  void measure(const Frame& frame, double t) {
    if (!patch_.usable() || t <= 0) return;
    const cv::Mat gray = gray_of(frame.image, gray_);
    const int reach = std::max({kLeastReachPx, patch_.patch().cols, patch_.patch().rows});
    const auto match = find(gray, patch_at_ + t * velocity_, reach);
    if (!match) return;
    sum_ = sum_ + t * (match->corner - patch_at_);
    weight_ += t * t;
    velocity_ = (1 / weight_) * sum_;
  }

  std::optional<PatchMatcher::Match> find(const cv::Mat& gray, Vec2 expected, int reach) {
    if (!patch_.usable()) return std::nullopt;
    return patch_.find(gray, window_around(expected, patch_.patch().size(), reach, gray.size()),
                       kLeastCorrelation);
  }

  static constexpr double kLeastPatchPx = 4;
  static constexpr double kLeastCorrelation = 0.5;
  static constexpr int kLeastReachPx = 16;

  StartBox box_;
  Time started_;
  Box picture_;
  PatchMatcher patch_;
  cv::Mat gray_;
  Vec2 patch_at_;  // px
  int frames_left_ = 0;
  Vec2 sum_;           // of t times displacement, px s
  double weight_ = 0;  // of t squared, s^2
  Vec2 velocity_;      // px/s
};

}  // namespace

std::unique_ptr<Tracker> still_tracker() { return std::make_unique<StillTracker>(); }

std::vector<OptionInfo> linear_option_list() {
  return {{"frames", fmt::format("{}", LinearOptions{}.frames), "frames",
           "delivered frames after the start from which the velocity is measured"}};
}

LinearOptions linear_options(const Options& given) { return {.frames = given.whole("frames", 0, 1000)}; }

std::unique_ptr<Tracker> linear_tracker(const LinearOptions& options) {
  return std::make_unique<LinearTracker>(options);
}

}  // namespace relock
