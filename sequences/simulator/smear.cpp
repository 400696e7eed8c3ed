#include "sequences/simulator/smear.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "core/error.h"

namespace relock::simulator {
namespace {

using Taps = std::array<float, 4>;

/// Weights of the samples at -1, 0, 1 and 2 for a place `f` behind sample 0: Keys' interpolation of third degree.
Taps cubic(double f) {
  const double f2 = f * f, f3 = f2 * f;
  return {static_cast<float>((-f3 + 2 * f2 - f) / 2), static_cast<float>((3 * f3 - 5 * f2 + 2) / 2),
          static_cast<float>((-3 * f3 + 4 * f2 + f) / 2), static_cast<float>((f3 - f2) / 2)};
}

/// out[i] = in at i + f, for `count` places from in[0] on; in[-1] to in[count + 1] must be there.
void shift_row(const float* in, double f, int count, float* out) {
  const Taps t = cubic(f);
  for (int i = 0; i < count; ++i)
    out[i] = t[0] * in[i - 1] + t[1] * in[i] + t[2] * in[i + 1] + t[3] * in[i + 2];
}

/// Of the rows up to `whole` away all count in full but the outermost, `last`; those one farther count `beyond`:
/// the integral from -half to half of what is linear between rows.
struct Window {
  int whole;
  float last, beyond, share;

  explicit Window(double half) : whole(static_cast<int>(half)) {
    const double rest = half - whole;
    last = static_cast<float>((whole > 0 ? 0.5 : 0) + (whole > 0 ? 1 : 2) * (rest - rest * rest / 2));
    beyond = static_cast<float>(rest * rest / 2);
    share = static_cast<float>(1 / (2 * half));
  }
};

/// Rows of a picture, each shifted to the left or right so that lines of a slope stand upright.
class Upright {
 public:
  /// `slope`: columns to the right for each row down.
  Upright(const cv::Mat1f& picture, double slope)
      : slope_(slope), rows_(picture.rows, picture.cols, 0.0F), sum_(lines(picture.size(), slope)) {
    for (int y = 0; y < rows_.rows; ++y) shift_row(picture[y] + 1, rest(y), rows_.cols - 3, rows_[y] + 1);
    first_ = slope > 0 ? whole(rows_.rows - 1) : 0;
  }

  int whole(int y) const { return static_cast<int>(std::floor(slope_ * y)); }
  double rest(int y) const { return slope_ * y - std::floor(slope_ * y); }
  /// Row `y` as it stands at column 0 of row `at`'s own columns; valid where both rows are.
  const float* row(int y, int at) const { return rows_[y] + (whole(y) - whole(at)); }
  /// The running sum in row `at`'s columns.
  const float* sum(int at) const { return sum_.data() + (first_ - whole(at)); }

  void add(int y) {
    float* sum = sum_.data() + (first_ - whole(y));
    const float* row = rows_[y];
    for (int x = 1; x < rows_.cols - 2; ++x) sum[x] += row[x];
  }
  void take(int y) {
    float* sum = sum_.data() + (first_ - whole(y));
    const float* row = rows_[y];
    for (int x = 1; x < rows_.cols - 2; ++x) sum[x] -= row[x];
  }

 private:
  static std::size_t lines(cv::Size size, double slope) {
    return static_cast<std::size_t>(size.width + std::ceil(std::abs(slope) * size.height) + 2);
  }

  double slope_;
  cv::Mat1f rows_;
  std::vector<float> sum_;
  int first_ = 0;
};

/// For lines that are nearer to upright than to level.
cv::Mat1f smeared_upright(const cv::Mat1f& picture, Vec2 way, int margin) {
  Upright upright(picture, way.x / way.y);
  const Window window(std::abs(way.y) / 2);
  const int n = window.whole, width = picture.cols - 2 * margin;
  cv::Mat1f out(picture.rows - 2 * margin, width);
  std::vector<float> mean(static_cast<std::size_t>(picture.cols));
  for (int y = margin - n + 1; y <= margin + n - 1; ++y) upright.add(y);
  for (int y = margin; y < picture.rows - margin; ++y) {
    const float *sum = upright.sum(y), *above = upright.row(y - n, y), *below = upright.row(y + n, y),
                *first = upright.row(y - n - 1, y), *last = upright.row(y + n + 1, y);
    const bool alone = n == 0;  // then the row itself is above and below at once
    const float half = alone ? window.last / 2 : window.last;
    for (int x = margin - 2; x < margin + width + 2; ++x)
      mean[static_cast<std::size_t>(x)] =
          window.share *
          ((alone ? 0.0F : sum[x]) + half * (above[x] + below[x]) + window.beyond * (first[x] + last[x]));
    // Back: what stands at x is the picture's at x + rest.
    const double rest = upright.rest(y);
    const int back = rest > 0 ? 1 : 0;
    shift_row(mean.data() + margin - back, back - rest, width, out[y - margin]);
    if (alone) continue;
    upright.add(y + n);
    upright.take(y - n + 1);
  }
  return out;
}

}  // namespace

int smear_margin(Vec2 way) {
  return static_cast<int>(std::ceil(std::max(std::abs(way.x), std::abs(way.y)) / 2)) + 6;
}

cv::Mat1f smeared(const cv::Mat1f& picture, Vec2 way, int margin) {
  if (margin < smear_margin(way) || 2 * margin >= std::min(picture.cols, picture.rows))
    throw Error(fmt::format("a picture of {}x{} px that moves by ({}, {}) px has no margin of {} px",
                            picture.cols, picture.rows, way.x, way.y, margin));
  if (way == Vec2{})
    return picture(cv::Rect(margin, margin, picture.cols - 2 * margin, picture.rows - 2 * margin));
  if (std::abs(way.y) >= std::abs(way.x)) return smeared_upright(picture, way, margin);
  cv::Mat1f turned, back;
  cv::transpose(picture, turned);
  cv::transpose(smeared_upright(turned, {way.y, way.x}, margin), back);
  return back;
}

}  // namespace relock::simulator
