#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/random.h"
#include "detectors/ring/line_scan.h"

namespace relock::ring {
namespace {

cv::Mat1b random_picture(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat1b picture(height, width);
  for (auto& pixel : picture) pixel = static_cast<std::uint8_t>(random.below(256));
  return picture;
}

double interpolated(const cv::Mat1b& picture, Vec2 at) {
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  const double right = at.x - x, down = at.y - y;
  const auto pixel = [&](int column, int row) -> double {
    return picture(std::min(row, picture.rows - 1), std::min(column, picture.cols - 1));
  };
  return (1 - down) * ((1 - right) * pixel(x, y) + right * pixel(x + 1, y)) +
         down * ((1 - right) * pixel(x, y + 1) + right * pixel(x + 1, y + 1));
}

TEST(LineScan, ReadsThePictureWhereItSaysItDoes) {
  const cv::Mat1b picture = random_picture(61, 47, 3);
  cv::Mat1b transposed;
  cv::transpose(picture, transposed);
  LineScan scan;
  for (const LineDirection& direction : kLineDirections) {
    scan.read(picture, transposed, direction);
    int read = 0;
    for (std::size_t rank = 0; rank < scan.size(); ++rank) {
      const Line line = scan[rank];
      for (int step = 0; step < line.steps; ++step, ++read) {
        const Vec2 at = line.at(step);
        ASSERT_GE(at.x, -1e-9);
        ASSERT_GE(at.y, -1e-9);
        ASSERT_LE(at.x, picture.cols - 1 + 1e-9);
        ASSERT_LE(at.y, picture.rows - 1 + 1e-9);
        // The fraction between two pixels has 8 bits: an error of up to 255/256, and the rounding.
        ASSERT_NEAR(line.values[step], interpolated(picture, at + Vec2{1e-9, 1e-9}), 1.6);
      }
    }
    EXPECT_GT(read, 0.9 * picture.cols * picture.rows / LineScan::kSpacing);
  }
}

TEST(LineScan, HasNoLinesWhereThePictureIsTooSmall) {
  LineScan scan;
  scan.read(random_picture(1, 9, 1), random_picture(9, 1, 1), kLineDirections[0]);
  EXPECT_EQ(scan.size(), 0U);
}

// The definition, one value at a time: what the vector loops must find whichever version of them runs.
std::vector<int> edges_one_by_one(const cv::Mat1b& line, int least) {
  std::vector<int> found;
  const auto rise = [&](int i) { return i < 1 || i + 1 >= line.cols ? 0 : line(0, i + 1) - line(0, i - 1); };
  for (int i = 1; i + 1 < line.cols; ++i) {
    const int sign = rise(i) < 0 ? -1 : 1, here = std::abs(rise(i));
    if (here > least && here >= sign * rise(i - 1) && here > sign * rise(i + 1)) found.push_back(i);
  }
  return found;
}

TEST(EdgeFinder, AgreesWithTheDefinitionOneValueAtATime) {
  EdgeFinder finder;
  for (int length = 3; length < 150; ++length) {
    const cv::Mat1b line = random_picture(length, 1, static_cast<std::uint64_t>(length));
    const Edges& edges = finder.find({line.ptr(), length, {}, {1, 0}}, 40);
    const std::vector<int> expected = edges_one_by_one(line, 40);
    ASSERT_EQ(edges.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(edges.at[i], expected[i], 0.5001);
      EXPECT_EQ(edges.rise[i], line(0, expected[i] + 1) - line(0, expected[i] - 1));
    }
  }
}

TEST(EdgeFinder, PutsTheEdgeOfAStepBetweenItsPixels) {
  cv::Mat1b line(1, 20, std::uint8_t{10});
  line.colRange(8, 20) = 200;
  EdgeFinder finder;
  const Edges& edges = finder.find({line.ptr(), 20, {}, {1, 0}}, 20);
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_FLOAT_EQ(edges.at[0], 7.5F);
}

}  // namespace
}  // namespace relock::ring
