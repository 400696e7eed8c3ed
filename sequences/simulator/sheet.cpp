#include "sequences/simulator/sheet.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/geometry.h"

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

/// Farthest from one place to the next on the sheet, in samples. Each place is a mean over two of them at least.
constexpr double kStep = 1.5;

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
  const int times = std::clamp(cvRound(steps(1)), 1, full / 2);
  const int side = full / times;
  cv::Mat1b reduced = target.picture;
  if (times > 1) cv::resize(target.picture, reduced, {side, side}, 0, 0, cv::INTER_AREA);

  Sampling made;
  made.sheet.create(side, side);
  std::transform(reduced.begin(), reduced.end(), made.sheet.begin(),
                 [&](std::uint8_t level) { return tones[level]; });
  made.to_sheet = to_samples(side);
  const Matrix2d jacobian = jacobian_at_middle(made.to_sheet, (side - 1) / 2.0);
  made.samples_per_px = {jacobian.row(0).norm(), jacobian.row(1).norm()};
  made.places = std::clamp(static_cast<int>(std::ceil(2 * steps(0) * side / full / kStep)), 2, 16);
  return made;
}

/// The part of the picture that the sheet may cover, row by row.
class Reach {
 public:
  Reach(const PrintedTarget& target, const Matrix3d& to_picture, cv::Size picture) : picture_(picture) {
    const double half = target.sheet_m / 2;
    for (const Vec2 corner : {Vec2{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
      const Vector3d at = to_picture * Vector3d(corner.x, corner.y, 1);
      if (at.z() > 1e-9) corners_.push_back({at.x() / at.z(), at.y() / at.z()});
    }
  }

  /// First column, and the one after the last; one pixel more than needed on either side.
  std::pair<int, int> columns(int y) const {
    if (corners_.size() < 4) return {0, picture_.width};  // it reaches beside the camera
    double left = 1e6, right = -1e6;
    for (std::size_t i = 0; i < 4; ++i) {
      Vec2 upper = corners_[i], lower = corners_[(i + 1) % 4];
      if (upper.y > lower.y) std::swap(upper, lower);
      const double from = std::max(upper.y, y - 1.0), to = std::min(lower.y, y + 1.0);
      if (!(from <= to)) continue;
      for (const double at : {from, to}) {
        const double part = lower.y > upper.y ? (at - upper.y) / (lower.y - upper.y) : 0;
        const double x = upper.x + part * (lower.x - upper.x);
        left = std::min({left, x, lower.y > upper.y ? x : lower.x});
        right = std::max({right, x, lower.y > upper.y ? x : lower.x});
      }
    }
    return {static_cast<int>(std::floor(std::max(left, 1.0))) - 1,
            static_cast<int>(std::ceil(std::min(right, picture_.width - 2.0))) + 2};
  }

 private:
  cv::Size picture_;
  std::vector<Vec2> corners_;
};

/// The sheet between its samples, and how much of a place it covers.
class Seen {
 public:
  explicit Seen(const Sampling& sampling)
      : sheet_(sampling.sheet),
        end_(static_cast<float>(sheet_.cols - 1)),
        sharp_u_(static_cast<float>(sampling.places / sampling.samples_per_px.x())),
        sharp_v_(static_cast<float>(sampling.places / sampling.samples_per_px.y())),
        whole_u_(std::max(0.0F, 0.5F / sharp_u_ - 0.5F)),
        whole_v_(std::max(0.0F, 0.5F / sharp_v_ - 0.5F)) {}

  /// Adds what is seen at a place to a pixel's sum, and how much of it to what is covered.
  void add(float u, float v, float& sum, float& covered) const {
    if (u >= whole_u_ && u < end_ - whole_u_ && v >= whole_v_ && v < end_ - whole_v_) {
      sum += at(u, v);
      covered += 1;
    } else if (const float part = part_of(u, sharp_u_) * part_of(v, sharp_v_); part > 0) {
      sum += part * at(std::clamp(u, 0.0F, end_), std::clamp(v, 0.0F, end_));
      covered += part;
    }
  }

 private:
  /// The edge is half a sample outside the outermost ones; around it, part of a place is covered.
  float part_of(float u, float sharp) const {
    return std::clamp((std::min(u, end_ - u) + 0.5F) * sharp + 0.5F, 0.0F, 1.0F);
  }
  float at(float u, float v) const {
    const int left = std::min(static_cast<int>(u), sheet_.cols - 2),
              top = std::min(static_cast<int>(v), sheet_.rows - 2);
    const float x = u - static_cast<float>(left), y = v - static_cast<float>(top);
    const float *above = sheet_[top] + left, *below = sheet_[top + 1] + left;
    const float over = above[0] + x * (above[1] - above[0]), under = below[0] + x * (below[1] - below[0]);
    return over + y * (under - over);
  }

  const cv::Mat1f& sheet_;
  float end_, sharp_u_, sharp_v_;
  float whole_u_, whole_v_;  // so far from the outermost samples, all of a place is covered
};

/// Draws one row after another.
class Drawing {
 public:
  Drawing(const Sampling& sampling, int width)
      : sampling_(sampling),
        seen_(sampling),
        sums_(static_cast<std::size_t>(width)),
        covered_(sums_.size()),
        u_(sums_.size() * static_cast<std::size_t>(sampling.places)),
        v_(u_.size()) {}

  /// From column `from` to before `to`.
  void row(int y, int from, int to, float* row) {
    const int n = sampling_.places;
    const auto count = static_cast<std::size_t>(to - from);
    std::fill_n(sums_.begin(), count, 0.0F);
    std::fill_n(covered_.begin(), count, 0.0F);
    for (int j = 0; j < n; ++j) {
      find({from - 0.5 + 0.5 / n, y - 0.5 + (j + 0.5) / n}, 1.0 / n, n * (to - from));
      std::size_t place = 0;
      for (std::size_t x = 0; x < count; ++x)
        for (int i = 0; i < n; ++i, ++place) seen_.add(u_[place], v_[place], sums_[x], covered_[x]);
    }
    const float share = 1.0F / static_cast<float>(n * n);
    for (std::size_t x = 0; x < count; ++x)
      row[from + static_cast<int>(x)] =
          share * sums_[x] + (1 - share * covered_[x]) * row[from + static_cast<int>(x)];
  }

 private:
  /// Where places are on the sheet, in samples. `place`: the first, px; `step`: to the next.
  void find(Vec2 place, double step, int count) {
    // The first in double; what is added over a row needs no more than float.
    const Eigen::Vector3f first = (sampling_.to_sheet * Vector3d(place.x, place.y, 1)).cast<float>(),
                          along = (sampling_.to_sheet.col(0) * step).cast<float>();
    const float first_u = first(0), first_v = first(1), first_w = first(2), along_u = along(0),
                along_v = along(1), along_w = along(2);
    float *us = u_.data(), *vs = v_.data();
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<float>(i);
      const float w = first_w + at * along_w;
      us[i] = w > 0 ? (first_u + at * along_u) / w : -1e9F;  // behind the camera: nowhere on the sheet
      vs[i] = w > 0 ? (first_v + at * along_v) / w : -1e9F;
    }
  }

  const Sampling& sampling_;
  Seen seen_;
  std::vector<float> sums_, covered_;  // of each pixel
  std::vector<float> u_, v_;           // of each place
};

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
  const Reach reach(target, to_picture, picture.size());
  Drawing drawing(sampling, picture.cols);
  for (int y = 0; y < picture.rows; ++y) {
    const auto [from, to] = reach.columns(y);
    if (from < to) drawing.row(y, from, to, picture[y]);
  }
}

}  // namespace relock::simulator
