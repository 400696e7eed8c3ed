#include "trackers/yardsticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/opencv.h"

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

/// Where between its neighbours the top of a parabola through three equally spaced values lies, in (-0.5,
/// 0.5).
double parabola_top(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

/// Top left corner, as a pixel of `picture`, of the place near `expected` that looks like `patch`.
std::optional<Vec2> find_patch(const cv::Mat& picture, const cv::Mat& patch, Vec2 expected, int reach) {
  constexpr double kLeastCorrelation = 0.5;
  // The picture's own box may be huge or far away: clipped while still double.
  const double left = std::max(0.0, std::round(expected.x) - reach),
               top = std::max(0.0, std::round(expected.y) - reach);
  const double right = std::min<double>(picture.cols, std::round(expected.x) + patch.cols + reach);
  const double bottom = std::min<double>(picture.rows, std::round(expected.y) + patch.rows + reach);
  if (!(right - left >= patch.cols && bottom - top >= patch.rows)) return std::nullopt;
  const cv::Rect window(static_cast<int>(left), static_cast<int>(top), static_cast<int>(right - left),
                        static_cast<int>(bottom - top));
  cv::Mat1f match;
  cv::matchTemplate(picture(window), patch, match, cv::TM_CCOEFF_NORMED);
  cv::patchNaNs(match, -1);
  cv::Point best;
  double correlation = 0;
  cv::minMaxLoc(match, nullptr, &correlation, nullptr, &best);
  if (!(correlation >= kLeastCorrelation)) return std::nullopt;
  Vec2 place{left + best.x, top + best.y};
  if (best.x > 0 && best.x + 1 < match.cols)
    place.x += parabola_top(match(best.y, best.x - 1), match(best), match(best.y, best.x + 1));
  if (best.y > 0 && best.y + 1 < match.rows)
    place.y += parabola_top(match(best.y - 1, best.x), match(best), match(best.y + 1, best.x));
  return place;
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
    const cv::Rect place = rounded_rect(inside) & cv::Rect(0, 0, gray.cols, gray.rows);
    cv::Scalar mean, deviation;
    cv::meanStdDev(gray(place), mean, deviation);
    if (deviation[0] < kLeastContrast) return;  // a flat patch looks like everything
    gray(place).copyTo(patch_);
    const Vec2 corner{static_cast<double>(place.x), static_cast<double>(place.y)};
    // Measured like all later places, so that what the parabola does wrong on this texture cancels.
    patch_at_ = find_patch(gray, patch_, corner, 2).value_or(corner);
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
    if (patch_.empty() || frame.image.empty() || t <= 0) return;
    const cv::Mat gray = gray_of(frame.image, gray_);
    const int reach = std::max({kLeastReachPx, patch_.cols, patch_.rows});
    const auto place = find_patch(gray, patch_, patch_at_ + t * velocity_, reach);
    if (!place) return;
    sum_ = sum_ + t * (*place - patch_at_);
    weight_ += t * t;
    velocity_ = (1 / weight_) * sum_;
  }

  static constexpr double kLeastPatchPx = 4;
  static constexpr double kLeastContrast = 2;  // grey levels, standard deviation
  static constexpr int kLeastReachPx = 16;

  StartBox box_;
  Time started_;
  Box picture_;
  cv::Mat patch_, gray_;
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
