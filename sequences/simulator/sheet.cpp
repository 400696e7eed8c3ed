#include "sequences/simulator/sheet.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/error.h"

namespace relock::simulator {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// The sheet in samples that suit the picture, and where these are seen.
struct Sampling {
  cv::Mat1f sheet;
  Matrix3d to_sheet;        ///< from homogeneous pixels to samples, centres at integers
  Vector2d samples_per_px;  ///< right and down on the sheet
  int places = 2;           ///< along each side of a pixel
};

/// How the sheet's own samples change with pixels, at its middle.
Matrix2d jacobian_at_middle(const Matrix3d& to_sheet, double middle) {
  const Vector3d at = to_sheet.inverse() * Vector3d(middle, middle, 1);
  const double w = (to_sheet * (at / at.z())).z();
  Matrix2d jacobian;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) jacobian(i, j) = (to_sheet(i, j) - middle * to_sheet(2, j)) / w;
  return jacobian;
}

/// From samples of a sheet of `side` samples to places on it.
Matrix3d places_of_samples(double sheet_m, int side) {
  const double sample_m = sheet_m / side;
  Matrix3d places = Matrix3d::Identity();
  places(0, 0) = places(1, 1) = sample_m;
  places(0, 2) = places(1, 2) = (0.5 - side / 2.0) * sample_m;
  return places;
}

Sampling sampling_of(const PrintedTarget& target, const Matrix3d& to_picture, const Tones& tones) {
  const auto to_samples = [&](int side) -> Matrix3d {
    return (to_picture * places_of_samples(target.sheet_m, side)).inverse();
  };
  const int full = target.picture.cols;
  const Vector2d steps = jacobian_at_middle(to_samples(full), (full - 1) / 2.0).jacobiSvd().singularValues() /
                         2;  // of two places
  const int side = std::clamp(static_cast<int>(std::ceil(full / std::max(steps(1), 1.0))), 2, full);
  cv::Mat1b reduced = target.picture;
  if (side < full) cv::resize(target.picture, reduced, {side, side}, 0, 0, cv::INTER_AREA);

  Sampling made;
  made.sheet.create(side, side);
  std::transform(reduced.begin(), reduced.end(), made.sheet.begin(),
                 [&](std::uint8_t level) { return tones[level]; });
  made.to_sheet = to_samples(side);
  const Matrix2d jacobian = jacobian_at_middle(made.to_sheet, (side - 1) / 2.0);
  made.samples_per_px = {jacobian.row(0).norm(), jacobian.row(1).norm()};
  made.places = std::clamp(static_cast<int>(std::ceil(2 * steps(0) * side / full - 1e-6)), 2, 16);
  return made;
}

/// The part of the picture that the sheet may cover.
cv::Rect reach_of(const PrintedTarget& target, const Matrix3d& to_picture, cv::Size picture) {
  const cv::Rect whole({0, 0}, picture);
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const Vector3d at = to_picture * Vector3d(x * target.sheet_m, y * target.sheet_m, 1);
      if (!(at.z() > 1e-9)) return whole;  // it reaches beside the camera
      left = std::min(left, at.x() / at.z()), right = std::max(right, at.x() / at.z());
      top = std::min(top, at.y() / at.z()), bottom = std::max(bottom, at.y() / at.z());
    }
  const auto least = [](double at) { return static_cast<int>(std::floor(std::clamp(at, -1e6, 1e6))) - 1; };
  return cv::Rect({least(left), least(top)}, cv::Point{least(right) + 4, least(bottom) + 4}) & whole;
}

/// Adds up what is seen at places of a pixel.
class PixelSum {
 public:
  explicit PixelSum(const Sampling& sampling)
      : sheet_(sampling.sheet),
        end_(static_cast<float>(sheet_.cols - 1)),
        sharp_x_(static_cast<float>(sampling.places / sampling.samples_per_px.x())),
        sharp_y_(static_cast<float>(sampling.places / sampling.samples_per_px.y())) {}

  void add(float u, float v) {
    // Of the edge, half a sample outside the outermost ones, as much is covered as of the place's own part of the pixel.
    const float inside = std::min(std::min(u, end_ - u) + 0.5F, 1e6F) * sharp_x_ + 0.5F;
    const float inside_y = std::min(std::min(v, end_ - v) + 0.5F, 1e6F) * sharp_y_ + 0.5F;
    if (!(inside > 0 && inside_y > 0)) return;
    const float covered = std::min(inside, 1.0F) * std::min(inside_y, 1.0F);
    const float x = std::clamp(u, 0.0F, end_), y = std::clamp(v, 0.0F, end_);
    const int left = std::min(static_cast<int>(x), sheet_.cols - 2),
              top = std::min(static_cast<int>(y), sheet_.rows - 2);
    const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
    const float *above = sheet_[top] + left, *below = sheet_[top + 1] + left;
    const float over = above[0] + fx * (above[1] - above[0]), under = below[0] + fx * (below[1] - below[0]);
    sum_ += covered * (over + fy * (under - over));
    covered_ += covered;
  }
  float over(float behind, float share) const { return share * sum_ + (1 - share * covered_) * behind; }
  bool any() const { return covered_ > 0; }
  void clear() { sum_ = covered_ = 0; }

 private:
  const cv::Mat1f& sheet_;
  float end_, sharp_x_, sharp_y_;
  float sum_ = 0, covered_ = 0;
};

/// One row, from column `from` to before `to`.
void draw_row(const Sampling& sampling, int y, int from, int to, float* row) {
  const Matrix3d& h = sampling.to_sheet;
  const int n = sampling.places;
  const float share = 1.0F / static_cast<float>(n * n);
  PixelSum pixel(sampling);
  for (int x = from; x < to; ++x) {
    pixel.clear();
    for (int j = 0; j < n; ++j) {
      const double at_y = y - 0.5 + (j + 0.5) / n, first_x = x - 0.5 + 0.5 / n;
      double u = h(0, 0) * first_x + h(0, 1) * at_y + h(0, 2),
             v = h(1, 0) * first_x + h(1, 1) * at_y + h(1, 2),
             w = h(2, 0) * first_x + h(2, 1) * at_y + h(2, 2);
      for (int i = 0; i < n; ++i, u += h(0, 0) / n, v += h(1, 0) / n, w += h(2, 0) / n) {
        if (!(w > 0)) continue;
        const double part = 1 / w;
        pixel.add(static_cast<float>(u * part), static_cast<float>(v * part));
      }
    }
    if (pixel.any()) row[x] = pixel.over(row[x], share);
  }
}

[[noreturn]] void refuse(const PrintedTarget& target, std::string_view what) {
  throw Error(fmt::format("the sheet of {} {}", target.name, what));
}

}  // namespace

void check_sheet(const PrintedTarget& target) {
  if (target.picture.type() != CV_8UC1 || target.picture.cols < 2 ||
      target.picture.rows != target.picture.cols)
    refuse(target, "must be a square picture of grey levels");
  if (!(target.size_m > 0 && target.sheet_m >= target.size_m))
    refuse(target, "must be no smaller than the target on it");
}

void draw_sheet(const PrintedTarget& target, const Matrix3d& to_picture, const Tones& tones,
                cv::Mat1f& picture) {
  Sampling sampling = sampling_of(target, to_picture, tones);
  // The sign that is in front of the camera is the middle's.
  const Vector3d middle = to_picture.col(2);
  if ((sampling.to_sheet * (middle / middle.z())).z() < 0) sampling.to_sheet = -sampling.to_sheet;
  const cv::Rect reach = reach_of(target, to_picture, picture.size());
  for (int y = reach.y; y < reach.y + reach.height; ++y)
    draw_row(sampling, y, reach.x, reach.x + reach.width, picture[y]);
}

}  // namespace relock::simulator
