#include "trackers/patch_searcher.h"

#include "core/opencv.h"
#include "trackers/patch_match.h"
#include "trackers/start_box.h"

namespace relock {
namespace {

class PatchSearcher final : public Searcher {
 public:
  void remember(const Image& image, const Box& box) override {
    if (image.empty()) return;
    place_ = whole_pixels(intersect(box, picture_box(image.size())), image.size());
    box_ = box;
    matcher_ = {};
    if (place_.empty()) return;
    const cv::Mat pixels = gray_of(cut(image, place_), gray_);
    matcher_.set(pixels, cv::Rect({}, pixels.size()));
  }

  std::optional<Found> find(const Image& image, const Box& region) override {
    if (image.empty() || !matcher_.usable()) return std::nullopt;
    const cv::Rect window = whole_pixels(intersect(region, picture_box(image.size())), image.size());
    if (window.empty()) return std::nullopt;
    const cv::Mat pixels = gray_of(cut(image, window), gray_);
    const auto match = matcher_.find(pixels, cv::Rect({}, pixels.size()), 0);
    if (!match) return std::nullopt;
    const Vec2 moved{window.x + match->corner.x - place_.x, window.y + match->corner.y - place_.y};
    return Found{{box_.x + moved.x, box_.y + moved.y, box_.width, box_.height}, match->correlation};
  }

 private:
  /// Only what is needed is made grey.
  static Image cut(const Image& image, const cv::Rect& place) {
    const std::uint8_t* first = image.row(place.y) + place.x * channels(image.format());
    return Image(first, {place.width, place.height}, image.format(), image.stride());
  }

  PatchMatcher matcher_;
  cv::Rect place_;
  Box box_;
  cv::Mat gray_;
};

}  // namespace

std::unique_ptr<Searcher> patch_searcher() { return std::make_unique<PatchSearcher>(); }

}  // namespace relock
