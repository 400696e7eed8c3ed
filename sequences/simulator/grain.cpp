#include "sequences/simulator/grain.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"

namespace relock::simulator {
namespace {

// Where pixels fall between lattice points, along one axis.
struct Places {
  std::int64_t first = 0;  // lattice point of the first pixel
  std::vector<int> index;  // of the lattice point before each pixel, from `first`
  std::vector<float> weight;
};

Places places(double start, double length, int pixels, double cell) {
  Places made;
  made.first = static_cast<std::int64_t>(std::floor(start / cell));
  for (int i = 0; i < pixels; ++i) {
    const double at = (start + (i + 0.5) * length / pixels) / cell;
    const double before = std::floor(at);
    const double rest = at - before;
    made.index.push_back(static_cast<int>(static_cast<std::int64_t>(before) - made.first));
    made.weight.push_back(static_cast<float>(rest * rest * (3 - 2 * rest)));
  }
  return made;
}

cv::Mat lattice(const Random& random, const Places& across, const Places& along) {
  cv::Mat made(along.index.back() + 2, across.index.back() + 2, CV_32FC1);
  for (int j = 0; j < made.rows; ++j) {
    const Random row = random.fork(static_cast<std::uint64_t>(along.first + j));
    for (int i = 0; i < made.cols; ++i) {
      Random point = row.fork(static_cast<std::uint64_t>(across.first + i));
      made.at<float>(j, i) = static_cast<float>(2 * point.uniform() - 1);
    }
  }
  return made;
}

void add_octave(const cv::Mat& points, const Places& across, const Places& along, float strength,
                cv::Mat& sum) {
  std::vector<float> between(static_cast<std::size_t>(points.cols));
  for (int y = 0; y < sum.rows; ++y) {
    const auto row = static_cast<std::size_t>(y);
    const float* above = points.ptr<float>(along.index[row]);
    const float* below = points.ptr<float>(along.index[row] + 1);
    for (std::size_t i = 0; i < between.size(); ++i)
      between[i] = strength * (above[i] + along.weight[row] * (below[i] - above[i]));
    auto* out = sum.ptr<float>(y);
    for (std::size_t x = 0; x < across.index.size(); ++x) {
      const float* left = between.data() + across.index[x];
      out[x] += left[0] + across.weight[x] * (left[1] - left[0]);
    }
  }
}

}  // namespace

cv::Mat grain_over(const Grain& grain, const cv::Rect2d& area, const cv::Size& size) {
  const double pixel = std::max(area.width / size.width / grain.stretch, area.height / size.height);
  cv::Mat sum(size, CV_32FC1, cv::Scalar(0));
  const Random random(grain.seed);
  // Uniform in [-1, 1) has variance 1/3, interpolated about half of it. All octaves count, also those left out,
  // so that the shown ones are as strong in a coarse picture as in a fine one.
  double variance = 0;
  std::uint64_t octave = 0;
  double strength = 1;
  for (double cell = grain.coarsest_m; cell >= grain.finest_m; cell /= 2, strength *= grain.fall) {
    variance += strength * strength * 0.18;
    ++octave;
    if (cell < 1.5 * pixel) continue;
    const Places across = places(area.x, area.width, size.width, cell * grain.stretch);
    const Places along = places(area.y, area.height, size.height, cell);
    add_octave(lattice(random.fork(octave), across, along), across, along, static_cast<float>(strength), sum);
  }
  return sum / std::sqrt(variance);
}

double number_of_cell(std::uint64_t seed, std::int64_t column, std::int64_t row) {
  return Random(seed)
      .fork(static_cast<std::uint64_t>(column))
      .fork(static_cast<std::uint64_t>(row))
      .uniform();
}

}  // namespace relock::simulator
