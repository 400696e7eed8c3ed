#include "eval/inspection/blur_estimate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/opencv.h"
#include "source_folder.h"

namespace relock {
namespace {

using std::numbers::pi;

cv::Mat1b photo(int number) {
  return cv::imread(fmt::format(RELOCK_SOURCE_DIR "/recordings/klahaag/images/{:05d}.jpg", number),
                    cv::IMREAD_GRAYSCALE);
}

/// A straight even motion of `length` px, drawn in sixteenths of a pixel.
cv::Mat1f line_kernel(double length, double direction) {
  const int half = static_cast<int>(std::ceil(length / 2)) + 1, points = static_cast<int>(16 * length) + 8;
  cv::Mat1f kernel(2 * half + 1, 2 * half + 1, 0.F);
  for (int i = 0; i < points; ++i) {
    const double t = ((i + 0.5) / points - 0.5) * length;
    const double x = half + t * std::cos(direction), y = half + t * std::sin(direction);
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    for (int dy = 0; dy < 2; ++dy)
      for (int dx = 0; dx < 2; ++dx)
        kernel(top + dy, left + dx) +=
            static_cast<float>((1 - std::abs(x - left - dx)) * (1 - std::abs(y - top - dy)) / points);
  }
  return kernel;
}

/// The picture moved over the exposure, with a camera's noise, and stored as a JPEG.
cv::Mat1b blurred(const cv::Mat1b& picture, double length, double direction, std::uint64_t seed = 1) {
  cv::Mat1f exposed;
  picture.convertTo(exposed, CV_32F);
  if (length > 0)
    cv::filter2D(exposed, exposed, CV_32F, line_kernel(length, direction), {-1, -1}, 0, cv::BORDER_REFLECT);
  cv::Mat1f noise(exposed.size());
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0, 1);
  cv::Mat1b stored;
  cv::Mat(exposed + noise).convertTo(stored, CV_8U);
  std::vector<std::uint8_t> file;
  cv::imencode(".jpg", stored, file, {cv::IMWRITE_JPEG_QUALITY, 92});
  return cv::imdecode(file, cv::IMREAD_GRAYSCALE);
}

double apart_deg(double a, double b) {
  const double d = std::fmod(std::abs(a - b), pi);
  return 180 / pi * std::min(d, pi - d);
}

/// How the answers over pictures and directions compare with the truth.
struct Tally {
  int asked = 0, declined = 0, below = 0, right = 0, wrong = 0;
  double worst_share = 0, worst_deg = 0;

  void add(const std::optional<BlurEstimate>& said, double length, double direction, double share, double px,
           double deg) {
    ++asked;
    if (!said) return void(++declined);
    if (said->length_px == 0) return void(++below);
    const double off = std::abs(said->length_px - length), turn = apart_deg(said->direction_rad, direction);
    (length > 0 && off <= share * length + px && turn <= deg ? right : wrong) += 1;
    if (length > 0) worst_share = std::max(worst_share, off / length), worst_deg = std::max(worst_deg, turn);
  }
  std::string line(double length) const {
    return fmt::format("{:6.0f} {:7d} {:9d} {:8d} {:7d} {:7d}   {:4.0f} %   {:3.0f} deg\n", length, asked,
                       below, declined, right, wrong, 100 * worst_share, worst_deg);
  }
};
constexpr const char* kTable = "true px   asked   below 3 declined   right   wrong   largest errors\n";

TEST(BlurEstimate, OfAWholePictureIsWithinTenPercentFrom3To20Pixels) {
  const BlurEstimator estimator;
  std::string table = kTable;
  for (const double length : {0, 2, 3, 4, 6, 9, 12, 16, 20}) {
    Tally tally;
    for (int i = 0; i < 8; ++i) {
      const double direction = pi * (i + 0.37) / 8;
      const cv::Mat1b picture = blurred(photo(1 + 7 * i), length, direction);
      tally.add(estimator.estimate(view(picture)), length, direction, 0.10, 0, length < 6 ? 15 : 5);
    }
    table += tally.line(length);
    if (length == 0) {
      EXPECT_EQ(tally.below, tally.asked) << "sharp pictures";
    }
    if (length >= 3) {
      EXPECT_EQ(tally.wrong, 0) << length << " px";
    }
    if (length >= 3 && length <= 16) {
      EXPECT_GE(tally.right, tally.asked - 1) << length << " px";
    }
  }
  fmt::print("{}", table);
}

TEST(BlurEstimate, OfATargetIsRightInTwoOfThreeAnswersOrMoreAndHardlyEverBlursASharpOne) {
  const BlurEstimator estimator;
  const std::array<Box, 5> regions{{{257.5, 45.5, 42, 53},
                                    {59.5, 30.5, 48, 55},
                                    {486.5, 37.5, 46, 48},
                                    {399.5, 99.5, 48, 48},
                                    {149.5, 119.5, 48, 48}}};
  std::string table = kTable;
  for (const double length : {0, 2, 3, 4, 6, 9, 12, 16}) {
    Tally tally;
    for (const Box& region : regions)
      for (int i = 0; i < 6; ++i) {
        const double direction = pi * (i + 0.37) / 6;
        const cv::Mat1b picture = blurred(photo(1 + 9 * i), length, direction);
        tally.add(estimator.estimate(view(picture), region), length, direction, 0.25, 0.5, 20);
      }
    table += tally.line(length);
    if (length >= 4) {
      EXPECT_GE(tally.right, 2 * tally.wrong) << length << " px";
    }
    if (length == 0) {
      EXPECT_LE(tally.wrong, tally.asked / 15) << "sharp pictures";
    }
  }
  fmt::print("{}", table);
}

TEST(BlurEstimate, TurnsWhenPictureAndBlurTurnTogether) {
  const BlurEstimator estimator;
  const cv::Mat1b picture = blurred(photo(1), 8, 0.4);
  cv::Mat turned;
  cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);
  const auto before = estimator.estimate(view(picture)), after = estimator.estimate(view(turned));
  ASSERT_TRUE(before && after);
  EXPECT_NEAR(before->length_px, after->length_px, 0.5);
  EXPECT_NEAR(apart_deg(after->direction_rad, before->direction_rad), 90, 8);
}

TEST(BlurEstimate, IsTheSameForAPictureOfHalfTheContrastAndForItsNegative) {
  const BlurEstimator estimator;
  const cv::Mat1b picture = blurred(photo(10), 6, 2.0);
  const cv::Mat dim = picture / 2 + 60, negative = 255 - picture;
  const auto said = estimator.estimate(view(picture));
  ASSERT_TRUE(said && estimator.estimate(view(dim)));
  EXPECT_NEAR(estimator.estimate(view(dim))->length_px, said->length_px, 0.4);
  EXPECT_NEAR(estimator.estimate(view(negative))->length_px, said->length_px, 0.05);
}

TEST(BlurEstimate, SaysNothingOfARegionTooSmallAndNoneOfAnEmptyPicture) {
  const BlurEstimator estimator;
  EXPECT_FALSE(estimator.estimate(view(photo(1)), Box{9.5, 9.5, 20, 20}));
  EXPECT_FALSE(estimator.estimate(view(cv::Mat1b(40, 40, std::uint8_t{7}))));
  const auto flat = estimator.estimate(view(cv::Mat1b(200, 200, std::uint8_t{7})));
  EXPECT_TRUE(!flat || flat->length_px == 0);
}

}  // namespace
}  // namespace relock
