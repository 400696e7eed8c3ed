#include "surface_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>

#include "../frames.h"

namespace recordings {
namespace {

constexpr int kFeatures = 150;
constexpr double kReturnsWithin = 0.3;  // px, forward and back again
constexpr int kFitRounds = 12;
constexpr double kLeastScale = 0.15;  // px; the flow is not better than this

struct Match {
  cv::Point2d from;
  cv::Point2d to;
};

cv::Point2d apply(const cv::Matx33d& affine, const cv::Point2d& p) {
  return {affine(0, 0) * p.x + affine(0, 1) * p.y + affine(0, 2),
          affine(1, 0) * p.x + affine(1, 1) * p.y + affine(1, 2)};
}

cv::Mat1b grey(const std::filesystem::path& file) {
  cv::Mat1b picture;
  cv::cvtColor(read_frame(file), picture, cv::COLOR_BGR2GRAY);
  return picture;
}

// Where the surface is in a later frame; what has left the picture has no features.
cv::Mat1b surface_mask(const cv::Size& size, const cv::Rect& surface, const cv::Matx33d& from_first) {
  std::vector<cv::Point> corners;
  for (const cv::Point& p : {surface.tl(), cv::Point(surface.br().x, surface.y), surface.br(),
                             cv::Point(surface.x, surface.br().y)}) {
    corners.emplace_back(apply(from_first, p));
  }
  cv::Mat1b mask(size, 0);
  cv::fillConvexPoly(mask, corners, cv::Scalar(255));
  return mask;
}

std::vector<Match> matches(const cv::Mat1b& now, const cv::Mat1b& next, const cv::Mat1b& mask) {
  std::vector<cv::Point2f> from, to, back;
  std::vector<unsigned char> there, and_back;
  cv::goodFeaturesToTrack(now, from, kFeatures, 0.01, 5, mask);
  if (from.empty()) return {};
  const cv::Size window(15, 15);
  const int levels = 3;
  cv::calcOpticalFlowPyrLK(now, next, from, to, there, cv::noArray(), window, levels);
  cv::calcOpticalFlowPyrLK(next, now, to, back, and_back, cv::noArray(), window, levels);
  std::vector<Match> found;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const bool returns = there[i] != 0 && and_back[i] != 0 && cv::norm(back[i] - from[i]) < kReturnsWithin;
    if (returns) found.push_back({from[i], to[i]});
  }
  return found;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

cv::Matx33d median_shift(const std::vector<Match>& all) {
  std::vector<double> dx, dy;
  for (const Match& m : all) {
    dx.push_back(m.to.x - m.from.x);
    dy.push_back(m.to.y - m.from.y);
  }
  return {1, 0, median(dx), 0, 1, median(dy), 0, 0, 1};
}

cv::Matx33d weighted_affine(const std::vector<Match>& all, const std::vector<double>& weights) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right_x(0, 0, 0);
  cv::Vec3d right_y(0, 0, 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const cv::Vec3d p(all[i].from.x, all[i].from.y, 1);
    normal += weights[i] * (p * p.t());
    right_x += weights[i] * all[i].to.x * p;
    right_y += weights[i] * all[i].to.y * p;
  }
  const cv::Matx33d inverse = normal.inv();
  const cv::Vec3d row_x = inverse * right_x;
  const cv::Vec3d row_y = inverse * right_y;
  return {row_x[0], row_x[1], row_x[2], row_y[0], row_y[1], row_y[2], 0, 0, 1};
}

// Iterated least squares with Cauchy weights: no random sampling, so the same answer everywhere.
cv::Matx33d robust_affine(const std::vector<Match>& all) {
  cv::Matx33d affine = median_shift(all);
  for (int round = 0; round < kFitRounds; ++round) {
    std::vector<double> residuals;
    for (const Match& m : all) residuals.push_back(cv::norm(apply(affine, m.from) - m.to));
    const double scale = std::max(median(residuals), kLeastScale);
    std::vector<double> weights;
    for (const double r : residuals) weights.push_back(1 / (1 + r * r / (scale * scale)));
    affine = weighted_affine(all, weights);
  }
  return affine;
}

// The difference of two independent halves has twice the standard deviation of the whole.
double half_difference(const std::vector<Match>& all, const cv::Point2d& centre) {
  std::array<std::vector<Match>, 2> half;
  for (std::size_t i = 0; i < all.size(); ++i) half.at(i % 2).push_back(all[i]);
  const cv::Point2d d = apply(robust_affine(half[0]), centre) - apply(robust_affine(half[1]), centre);
  return d.ddot(d) / 2 / 4;  // per coordinate, of the whole
}

}  // namespace

SurfaceMotion follow_surface(const std::vector<std::filesystem::path>& frames, const cv::Rect& surface) {
  const cv::Point2d centre(surface.x + surface.width / 2.0, surface.y + surface.height / 2.0);
  const auto steps = static_cast<double>(frames.size() - 1);
  SurfaceMotion motion;
  motion.from_first.push_back(cv::Matx33d::eye());
  cv::Mat1b now = grey(frames.front());
  for (std::size_t next_frame = 1; next_frame < frames.size(); ++next_frame) {
    const cv::Mat1b next = grey(frames[next_frame]);
    const cv::Matx33d& pose = motion.from_first.back();
    const auto found = matches(now, next, surface_mask(now.size(), surface, pose));
    if (found.size() < 20) {
      throw std::runtime_error("too little texture to follow into " + frames[next_frame].string());
    }
    motion.features += static_cast<double>(found.size()) / steps;
    motion.jitter_px += half_difference(found, apply(pose, centre)) / steps;
    motion.from_first.push_back(robust_affine(found) * pose);
    now = next;
  }
  motion.jitter_px = std::sqrt(motion.jitter_px);
  return motion;
}

}  // namespace recordings
