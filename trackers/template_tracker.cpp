#include "trackers/template_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/opencv.h"
#include "trackers/checked_tracker.h"
#include "trackers/patch_match.h"
#include "trackers/start_box.h"

namespace relock {
namespace {

constexpr int kLeastShrunkPx = 8;

class TemplateFollower final : public Follower {
 public:
  explicit TemplateFollower(const TemplateOptions& options) : options_(options) {}

  void start(const Image& picture, const Box& box) override {
    const cv::Mat gray = gray_of(picture, gray_);
    const cv::Rect place = whole_pixels(box, picture.size());
    fine_.set(gray, place);
    box_ = box;
    start_ = {static_cast<double>(place.x), static_cast<double>(place.y)};
    // Measured like all later places, so that what the parabola does wrong on this texture cancels.
    if (const auto match = fine_.find(gray, grown(place, 2), 0)) start_ = match->corner;
    shrink_ = std::clamp(std::min(place.width, place.height) / kLeastShrunkPx, 1, options_.shrink);
    if (shrink_ == 1 || !fine_.usable()) return;
    cv::Mat small;
    cv::resize(fine_.patch(), small, {}, 1.0 / shrink_, 1.0 / shrink_, cv::INTER_AREA);
    coarse_.set(small, cv::Rect({}, small.size()));
  }

  std::optional<Sighting> follow(const Image& picture) override {
    const cv::Mat gray = gray_of(picture, gray_);
    const auto match = fine_.find(gray, window(gray), options_.least_correlation);
    if (!match) return std::nullopt;
    const Vec2 moved = match->corner - start_;
    Sighting sighting = sighting_of(Box{box_.x + moved.x, box_.y + moved.y, box_.width, box_.height});
    sighting.confidence = match->correlation;
    return sighting;
  }

 private:
  static cv::Rect grown(const cv::Rect& rect, int by) {
    return {rect.x - by, rect.y - by, rect.width + 2 * by, rect.height + 2 * by};
  }

  /// Where the patch is searched for pixel by pixel: everywhere, or around the best place of the small
  /// picture.
  cv::Rect window(const cv::Mat& gray) {
    const cv::Rect everywhere({}, gray.size());
    if (!coarse_.usable()) return everywhere;
    cv::resize(gray, small_, {}, 1.0 / shrink_, 1.0 / shrink_, cv::INTER_AREA);
    const auto match = coarse_.find(small_, cv::Rect({}, small_.size()), 0);
    if (!match) return {};
    const auto full = [&](double small) { return static_cast<int>(std::lround(small * shrink_)); };
    const cv::Point corner(full(match->corner.x), full(match->corner.y));
    return grown(cv::Rect(corner, fine_.patch().size()), 2 * shrink_) & everywhere;
  }

  TemplateOptions options_;
  int shrink_ = 1;
  PatchMatcher fine_, coarse_;
  cv::Mat gray_, small_;
  Box box_;     // as it was started
  Vec2 start_;  // where the patch was found then
};

}  // namespace

std::vector<OptionInfo> template_option_list() {
  const TemplateOptions d;
  return {{"least_correlation", fmt::format("{}", d.least_correlation), "",
           "normalised correlation below which the target is called lost; blur lowers it, too"},
          {"shrink", fmt::format("{}", d.shrink), "",
           "how many times smaller the picture is searched first; more is faster and misses fine texture"}};
}

TemplateOptions template_options(const Options& given) {
  return {.least_correlation = given.number("least_correlation", 0, 1),
          .shrink = given.whole("shrink", 1, 16)};
}

std::unique_ptr<Tracker> template_tracker(const TemplateOptions& options) {
  return checked_tracker("template", [&] { return std::make_unique<TemplateFollower>(options); });
}

}  // namespace relock
