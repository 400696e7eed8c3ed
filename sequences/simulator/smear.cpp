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

/// Rows of a picture, each shifted to the left or right so that lines of a slope stand upright, and a running sum
/// down them. Only as many rows are kept as a window needs: memory costs more time than arithmetic.
class Upright {
 public:
  /// `slope`: columns to the right for each row down. `kept`: rows at a time. `next`: the first one.
  Upright(const cv::Mat1f& picture, double slope, int kept, int next)
      : picture_(picture),
        slope_(slope),
        rows_(kept, picture.cols, 0.0F),
        sum_(lines(picture.size(), slope)),
        first_(slope > 0 ? whole(picture.rows - 1) : 0),
        next_(next) {}

  double rest(int y) const { return slope_ * y - std::floor(slope_ * y); }
  /// Row `y` in row `at`'s columns; valid where both are.
  const float* row(int y, int at) const { return kept(y) + (whole(y) - whole(at)); }
  /// The running sum in row `at`'s columns.
  const float* sum(int at) const { return sum_.data() + (first_ - whole(at)); }

  void make_up_to(int y) {
    for (; next_ <= y; ++next_) shift_row(picture_[next_] + 1, rest(next_), rows_.cols - 3, kept(next_) + 1);
  }
  void add(int y) {
    float* sum = sum_.data() + (first_ - whole(y));
    const float* row = kept(y);
    for (int x = 1; x < rows_.cols - 2; ++x) sum[x] += row[x];
  }
  void take(int y) {
    float* sum = sum_.data() + (first_ - whole(y));
    const float* row = kept(y);
    for (int x = 1; x < rows_.cols - 2; ++x) sum[x] -= row[x];
  }

 private:
  static std::size_t lines(cv::Size size, double slope) {
    return static_cast<std::size_t>(size.width + std::ceil(std::abs(slope) * size.height) + 2);
  }
  int whole(int y) const { return static_cast<int>(std::floor(slope_ * y)); }
  const float* kept(int y) const { return rows_[y % rows_.rows]; }
  float* kept(int y) { return rows_[y % rows_.rows]; }

  const cv::Mat1f& picture_;
  double slope_;
  cv::Mat1f rows_;
  std::vector<float> sum_;
  int first_, next_;
};

/// Adds a row to the means of bins.
void add_binned(const float* row, int bin, float share, int count, float* means) {
  if (bin == 2) {  // what is nearly always asked for
    for (int x = 0; x < count; ++x) means[x] += share * (row[2 * x] + row[2 * x + 1]);
    return;
  }
  for (int x = 0; x < count; ++x)
    for (int i = 0; i < bin; ++i) means[x] += share * row[x * bin + i];
}

/// For lines that are nearer to upright than to level.
cv::Mat1f smeared_upright(const cv::Mat1f& picture, Vec2 way, int margin, int bin) {
  const Window window(std::abs(way.y) / 2);
  const int n = window.whole, width = picture.cols - 2 * margin, height = picture.rows - 2 * margin;
  const float share = 1.0F / static_cast<float>(bin * bin);
  Upright upright(picture, way.x / way.y, 2 * n + 3, margin - n - 1);
  cv::Mat1f out(height / bin, width / bin, 0.0F);
  std::vector<float> mean(static_cast<std::size_t>(picture.cols)), row(static_cast<std::size_t>(width));
  upright.make_up_to(margin + n);
  for (int y = margin - n + 1; y <= margin + n - 1; ++y) upright.add(y);
  for (int y = margin; y < margin + height; ++y) {
    upright.make_up_to(y + n + 1);
    const float *sum = upright.sum(y), *above = upright.row(y - n, y), *below = upright.row(y + n, y),
                *first = upright.row(y - n - 1, y), *last = upright.row(y + n + 1, y);
    // With n = 0 the row itself is above and below at once, and nothing was added to the sum.
    const float outer = window.share * (n == 0 ? window.last / 2 : window.last),
                beyond = window.share * window.beyond;
    float* means = mean.data();
    for (int x = margin - 2; x < margin + width + 2; ++x)
      means[x] = window.share * sum[x] + outer * (above[x] + below[x]) + beyond * (first[x] + last[x]);
    // Back: what stands at x is the picture's at x + rest.
    const double rest = upright.rest(y);
    const int back = rest > 0 ? 1 : 0;
    shift_row(means + margin - back, back - rest, width, row.data());
    add_binned(row.data(), bin, share, out.cols, out[(y - margin) / bin]);
    if (n == 0) continue;
    upright.add(y + n);
    upright.take(y - n + 1);
  }
  return out;
}

cv::Mat1f binned(const cv::Mat1f& picture, int margin, int bin) {
  cv::Mat1f out((picture.rows - 2 * margin) / bin, (picture.cols - 2 * margin) / bin, 0.0F);
  for (int y = 0; y < out.rows * bin; ++y)
    add_binned(picture[margin + y] + margin, bin, 1.0F / static_cast<float>(bin * bin), out.cols,
               out[y / bin]);
  return out;
}

}  // namespace

int smear_margin(Vec2 way) {
  return static_cast<int>(std::ceil(std::max(std::abs(way.x), std::abs(way.y)) / 2)) + 6;
}

cv::Mat1f smeared(const cv::Mat1f& picture, Vec2 way, int margin, int bin) {
  const int width = picture.cols - 2 * margin, height = picture.rows - 2 * margin;
  if (margin < smear_margin(way) || width <= 0 || height <= 0 || bin < 1 || width % bin != 0 ||
      height % bin != 0)
    throw Error(
        fmt::format("a picture of {}x{} px that moves by ({}, {}) px cannot have a margin of {} px and "
                    "bins of {} px",
                    picture.cols, picture.rows, way.x, way.y, margin, bin));
  if (way == Vec2{}) return binned(picture, margin, bin);
  if (std::abs(way.y) >= std::abs(way.x)) return smeared_upright(picture, way, margin, bin);
  cv::Mat1f turned, back;
  cv::transpose(picture, turned);
  cv::transpose(smeared_upright(turned, {way.y, way.x}, margin, bin), back);
  return back;
}

}  // namespace relock::simulator
