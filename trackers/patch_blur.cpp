#include "trackers/patch_blur.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/blur.h"
#include "core/opencv.h"

namespace relock {
namespace {

constexpr int kSmallPx = 24;    // the target is compared at this size
constexpr int kMarginPx = 4;    // shifts that are tried
constexpr int kContextPx = 12;  // around the first look: what blur smears into it
constexpr int kDirections = 12, kLengths = 8;
constexpr double kLeastLikeness = 0.5;
constexpr double kLeastGain = 0.02;  // in correlation, over the sharp look

struct Look {
  cv::Mat pixels;
  std::optional<BlurEstimate> blur;  // small pixels; empty: sharp
};

class PatchBlur {
 public:
  std::optional<BlurEstimate> operator()(const Image& image, const Box& box) {
    if (image.empty() || !well_formed(box)) return std::nullopt;
    if (looks_.empty()) return set_first_look(image, box), std::nullopt;
    const cv::Mat seen = small(image, box, kMarginPx);
    const Look* best = nullptr;
    double likeness = 0, sharp = 0;
    for (const Look& look : looks_) {
      const double alike = likeness_of(look, seen);
      if (!look.blur) sharp = alike;
      if (alike > likeness) likeness = alike, best = &look;
    }
    if (!best || !best->blur || likeness < kLeastLikeness || likeness < sharp + kLeastGain)
      return std::nullopt;
    return BlurEstimate{best->blur->direction_rad, best->blur->length_px / scale_of(box)};
  }

 private:
  /// Small pixels for one of the picture.
  static double scale_of(const Box& box) { return kSmallPx / size_of(box); }

  void set_first_look(const Image& image, const Box& box) {
    const cv::Mat sharp = small(image, box, kContextPx);
    looks_.push_back({within(sharp), {}});
    for (int d = 0; d < kDirections; ++d)
      for (int l = 1; l <= kLengths; ++l) {
        const BlurEstimate blur{d * std::numbers::pi / kDirections, 0.1 * l * kSmallPx};
        cv::Mat blurred;
        cv::filter2D(sharp, blurred, -1, blur_kernel(blur), {-1, -1}, 0, cv::BORDER_REPLICATE);
        looks_.push_back({within(blurred), blur});
      }
  }

  static cv::Mat within(const cv::Mat& pixels) {
    return pixels(
        cv::Rect(kContextPx, kContextPx, pixels.cols - 2 * kContextPx, pixels.rows - 2 * kContextPx));
  }

  /// The box and `margin` small pixels around it, as small as it is compared; the picture's edge goes on
  /// outside.
  cv::Mat small(const Image& image, const Box& box, int margin) {
    const double scale = scale_of(box);
    if (shape_.empty())
      shape_ = {std::max(4, static_cast<int>(std::lround(box.width * scale))),
                std::max(4, static_cast<int>(std::lround(box.height * scale)))};
    const cv::Size wanted(shape_.width + 2 * margin, shape_.height + 2 * margin);
    const Vec2 centre = centre_of(box);
    const double across = wanted.width / scale, down = wanted.height / scale;
    const cv::Size size(static_cast<int>(std::lround(across)), static_cast<int>(std::lround(down)));
    cv::Mat cut, grey, shrunk;
    cv::getRectSubPix(read_only_mat(image), size,
                      {static_cast<float>(centre.x), static_cast<float>(centre.y)}, cut);
    grey = gray_of(view(cut), buffer_);
    cv::resize(grey, shrunk, wanted, 0, 0, cv::INTER_AREA);
    return shrunk;
  }

  double likeness_of(const Look& look, const cv::Mat& seen) {
    cv::matchTemplate(seen, look.pixels, correlations_, cv::TM_CCOEFF_NORMED);
    cv::patchNaNs(correlations_, -1);
    double most = 0;
    cv::minMaxLoc(correlations_, nullptr, &most);
    return std::isfinite(most) ? most : -1;
  }

  std::vector<Look> looks_;
  cv::Size shape_;
  cv::Mat buffer_;
  cv::Mat1f correlations_;
};

}  // namespace

BlurMeter patch_blur() {
  return [meter = std::make_shared<PatchBlur>()](const Image& image, const Box& box) {
    return (*meter)(image, box);
  };
}

}  // namespace relock
