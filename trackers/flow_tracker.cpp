#include "trackers/flow_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>

#include "core/opencv.h"
#include "trackers/checked_tracker.h"
#include "trackers/start_box.h"

namespace relock {
namespace {

constexpr double kLeastShareInside = 0.25;           // of the box, to be called seen
constexpr double kLeastScale = 0.5, kMostScale = 2;  // from one frame to the next: more is no motion
constexpr double kLeastSidePx = 4;
constexpr double kInnerPart = 0.7;  // of the box's sides, where corners are looked for

Vec2 middle(const Box& box) { return {box.x + box.width / 2, box.y + box.height / 2}; }

/// The box scaled about its centre, and its centre moved to `centre`.
Box moved(const Box& box, Vec2 centre, double scale) {
  const double width = scale * box.width, height = scale * box.height;
  return {centre.x - width / 2, centre.y - height / 2, width, height};
}

using Points = std::vector<cv::Point2f>;

class FlowFollower final : public Follower {
 public:
  explicit FlowFollower(const FlowOptions& options)
      : options_(options), window_(options.window_px, options.window_px) {}

  void start(const Image& picture, const Box& box) override {
    size_ = picture.size();
    box_ = box;
    const cv::Mat gray = gray_of(picture, gray_);
    levels_ = make_pyramid(gray, options_.levels, last_);
    points_.clear();
    find_more_corners(gray);
  }

  void expect(const Box& prior, double) override { prior_ = prior; }

  std::optional<Sighting> follow(const Image& picture) override {
    const auto prior = std::exchange(prior_, std::nullopt);
    if (!enough(points_)) return std::nullopt;
    const cv::Mat gray = gray_of(picture, gray_);
    make_pyramid(gray, levels_, next_);
    const std::size_t tried = points_.size();
    follow_corners(prior.value_or(box_));
    if (!enough(from_)) return std::nullopt;
    const auto place = place_by_agreement();
    if (!place || share_inside(*place, picture_box(size_)) < kLeastShareInside) return std::nullopt;
    hold(*place, gray);
    Sighting sighting = sighting_of(box_);
    sighting.confidence = static_cast<double>(agreeing_) / static_cast<double>(tried);
    return sighting;
  }

 private:
  /// Returns how many halvings the picture is large enough for.
  int make_pyramid(const cv::Mat& gray, int levels, std::vector<cv::Mat>& pyramid) const {
    // Copied in any case: the pixels are not ours, and gone when the next picture comes.
    return cv::buildOpticalFlowPyramid(gray, pyramid, window_, levels, true, cv::BORDER_REFLECT_101,
                                       cv::BORDER_CONSTANT, false);
  }

  bool enough(const Points& points) const {
    return points.size() >= static_cast<std::size_t>(options_.least_inliers);
  }

  /// Follows the corners to the new picture, starting where `guess` puts them, and back. Afterwards from_ and
  /// to_ are those that came back.
  void follow_corners(const Box& guess) {
    const double scale = std::sqrt(guess.area() / box_.area());
    const Vec2 old_centre = middle(box_), new_centre = middle(guess);
    to_.clear();
    for (const cv::Point2f& p : points_)
      to_.emplace_back(static_cast<float>(new_centre.x + scale * (p.x - old_centre.x)),
                       static_cast<float>(new_centre.y + scale * (p.y - old_centre.y)));
    back_ = points_;
    const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01);
    cv::calcOpticalFlowPyrLK(last_, next_, points_, to_, there_, errors_, window_, levels_, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    cv::calcOpticalFlowPyrLK(next_, last_, to_, back_, here_, errors_, window_, levels_, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    from_.clear();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!there_[i] || !here_[i] || !(cv::norm(points_[i] - back_[i]) <= options_.return_px)) continue;
      from_.push_back(points_[i]);
      to_[kept++] = to_[i];
    }
    to_.resize(kept);
  }

  /// Where the similarity that most corners agree on puts the box; afterwards to_ is those that agree.
  std::optional<Box> place_by_agreement() {
    // OpenCV's RANSAC draws from a generator of its own, from the same seed at every call.
    const cv::Mat similarity =
        cv::estimateAffinePartial2D(from_, to_, agrees_, cv::RANSAC, options_.agreement_px);
    if (similarity.empty()) return std::nullopt;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < to_.size(); ++i)
      if (agrees_[i]) to_[kept++] = to_[i];
    to_.resize(kept);
    agreeing_ = kept;
    const cv::Matx23d m = similarity;
    const double scale = std::hypot(m(0, 0), m(1, 0));
    if (!enough(to_) || !(scale >= kLeastScale && scale <= kMostScale)) return std::nullopt;
    const Vec2 c = middle(box_);
    const Box place = moved(
        box_, {m(0, 0) * c.x + m(0, 1) * c.y + m(0, 2), m(1, 0) * c.x + m(1, 1) * c.y + m(1, 2)}, scale);
    if (std::min(place.width, place.height) < kLeastSidePx) return std::nullopt;
    return place;
  }

  /// The target is at `place` in the new picture, which the next one is compared with.
  void hold(const Box& place, const cv::Mat& gray) {
    box_ = place;
    std::swap(last_, next_);
    std::swap(points_, to_);
    if (points_.size() * 2 < static_cast<std::size_t>(options_.features)) find_more_corners(gray);
  }

  void find_more_corners(const cv::Mat& gray) {
    const cv::Rect place =
        whole_pixels(intersect(moved(box_, middle(box_), kInnerPart), picture_box(size_)), size_);
    if (place.width < 3 || place.height < 3) return;
    const double apart = std::max(2.0, std::sqrt(box_.area() / options_.features) / 2);
    cv::goodFeaturesToTrack(gray(place), fresh_, options_.features, 0.01, apart);
    const std::size_t held = points_.size();
    for (const cv::Point2f& corner : fresh_) {
      if (points_.size() >= static_cast<std::size_t>(options_.features)) break;
      const cv::Point2f p(corner.x + static_cast<float>(place.x), corner.y + static_cast<float>(place.y));
      const bool is_new = std::none_of(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(held),
                                       [&](const cv::Point2f& q) { return cv::norm(p - q) < apart; });
      if (is_new) points_.push_back(p);
    }
  }

  FlowOptions options_;
  cv::Size window_;
  int levels_ = 0;
  Size size_;
  Box box_;                           // in the last picture in which the target was held
  std::vector<cv::Mat> last_, next_;  // pyramids of that picture and of the new one
  Points points_;                     // corners in it
  std::optional<Box> prior_;
  std::size_t agreeing_ = 0;
  // Buffers.
  cv::Mat gray_;
  Points from_, to_, back_, fresh_;
  std::vector<std::uint8_t> there_, here_, agrees_;
  std::vector<float> errors_;
};

}  // namespace

std::vector<OptionInfo> flow_option_list() {
  const FlowOptions d;
  return {
      {"features", fmt::format("{}", d.features), "", "corners followed at most; more is slower"},
      {"window_px", fmt::format("{}", d.window_px), "px", "side of the window compared around each corner"},
      {"levels", fmt::format("{}", d.levels), "", "halvings of the picture; more reach faster motion"},
      {"return_px", fmt::format("{}", d.return_px), "px",
       "how far from its start a corner may come back when it is followed backwards"},
      {"agreement_px", fmt::format("{}", d.agreement_px), "px",
       "how far from the common motion a corner may be to agree with it"},
      {"least_inliers", fmt::format("{}", d.least_inliers), "",
       "corners that must agree, or the target is called lost"}};
}

FlowOptions flow_options(const Options& given) {
  return {.features = given.whole("features", 4, 10'000),
          .window_px = given.whole("window_px", 5, 101),
          .levels = given.whole("levels", 0, 8),
          .return_px = given.number("return_px", 0.01, 100),
          .agreement_px = given.number("agreement_px", 0.01, 100),
          .least_inliers = given.whole("least_inliers", 3, 10'000)};
}

std::unique_ptr<Tracker> flow_tracker(const FlowOptions& options) {
  return checked_tracker("flow", [&] { return std::make_unique<FlowFollower>(options); });
}

}  // namespace relock
