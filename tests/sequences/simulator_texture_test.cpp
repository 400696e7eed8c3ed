#include "sequences/simulator/texture.h"

#include <gtest/gtest.h>

#include "core/display_coding.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/random.h"

namespace relock::simulator {
namespace {

cv::Mat some_picture(cv::Size size, int type, std::uint64_t seed = 1) {
  cv::Mat picture(size, type);
  Random random(seed);
  for (int y = 0; y < picture.rows; ++y)
    for (int i = 0; i < picture.cols * picture.channels(); ++i)
      picture.ptr(y)[i] = static_cast<uchar>(random.below(256));
  return picture;
}

TEST(Srgb, ComesBackFromLinearLight) {
  for (int i = 0; i <= 1000; ++i) {
    const float coded = static_cast<float>(i) / 1000;
    EXPECT_NEAR(coded_of_light(light_of_coded(coded)), coded, 1e-5);
  }
}

TEST(Srgb, AgreesWithWorkedValuesOfTheStandard) {
  EXPECT_DOUBLE_EQ(light_of_coded(0), 0);
  EXPECT_DOUBLE_EQ(light_of_coded(1), 1);
  EXPECT_NEAR(light_of_coded(0.04045), 0.0031308, 1e-6);
  EXPECT_NEAR(light_of_coded(0.5), 0.2140411, 1e-6);
}

TEST(Texture, HasTheSameMeanLightInEveryLevelWhateverItsSize) {
  for (const cv::Size size : {cv::Size(64, 64), cv::Size(101, 37), cv::Size(3, 257), cv::Size(7, 7)}) {
    const Texture texture = make_texture(some_picture(size, CV_8UC4));
    const cv::Scalar mean = cv::mean(texture.levels.front());
    for (const cv::Mat& level : texture.levels)
      EXPECT_LT(cv::norm(cv::mean(level), mean), 1e-4) << size << " at " << level.size();
  }
}

TEST(Texture, IsHalvedDownToOneTexelOnTheShorterSide) {
  const Texture texture = make_texture(some_picture({101, 37}, CV_8UC3));
  EXPECT_EQ(texture.width(), 101);
  EXPECT_EQ(texture.height(), 37);
  for (std::size_t i = 1; i < texture.levels.size(); ++i) {
    EXPECT_EQ(texture.levels[i].cols, texture.levels[i - 1].cols / 2);
    EXPECT_EQ(texture.levels[i].rows, texture.levels[i - 1].rows / 2);
  }
  EXPECT_EQ(std::min(texture.levels.back().cols, texture.levels.back().rows), 1);
}

TEST(Texture, IsPremultipliedByItsCoverage) {
  const cv::Mat picture(4, 4, CV_8UC4, cv::Scalar(255, 0, 255, 51));
  for (const cv::Mat& level : make_texture(picture).levels) {
    const cv::Vec4f texel = level.at<cv::Vec4f>(0, 0);
    EXPECT_LT(cv::norm(texel - cv::Vec4f(0.2f, 0, 0.2f, 0.2f)), 1e-6);
  }
}

TEST(Texture, TakesLightInItsColoursAndNotInItsCoverage) {
  const cv::Mat picture = some_picture({16, 12}, CV_8UC4);
  const cv::Mat bright = make_texture(picture).levels.front();
  const cv::Mat dim = make_texture(picture, cv::Mat(2, 3, CV_32FC1, cv::Scalar(0.5))).levels.front();
  const cv::Vec4f a = bright.at<cv::Vec4f>(5, 7), b = dim.at<cv::Vec4f>(5, 7);
  EXPECT_LT(cv::norm(cv::Vec4f(a[0] / 2, a[1] / 2, a[2] / 2, a[3]) - b), 1e-6);
}

TEST(Texture, OfAGreyPictureIsThatOfTheSamePictureInColour) {
  const cv::Mat grey = some_picture({9, 5}, CV_8UC1);
  cv::Mat colour;
  cv::merge(std::vector{grey, grey, grey}, colour);
  EXPECT_EQ(cv::norm(make_texture(grey).levels.front(), make_texture(colour).levels.front()), 0);
}

}  // namespace
}  // namespace relock::simulator
