#include "core/picture.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

TEST(Picture, KeepsItsPixelsWhenTheViewedOnesAreGone) {
  std::vector<std::uint8_t> rows{1, 2, 3, 99, 4, 5, 6, 99};
  const Picture picture = Image(rows.data(), {3, 2}, PixelFormat::gray8, 4);
  rows.assign(8, 0);
  EXPECT_EQ(picture.pixels, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(picture.view().stride(), 3u);
  EXPECT_EQ(picture.view().row(1)[2], 6);
  const Picture copy = picture;
  EXPECT_NE(copy.view().row(0), picture.view().row(0));
}

TEST(Picture, OfNothingIsEmpty) {
  EXPECT_TRUE(Picture().view().empty());
  EXPECT_TRUE(Picture(Image()).view().empty());
  EXPECT_TRUE(Picture(cv::Mat()).view().empty());
}

TEST(Picture, IsMadeOfAnOpenCvPictureAndBecomesOneAgain) {
  cv::Mat whole(4, 5, CV_8UC3);
  cv::randu(whole, 0, 256);
  for (const cv::Mat& mat : {whole, cv::Mat(whole(cv::Rect(1, 1, 3, 2)))}) {
    const Picture picture = mat;
    EXPECT_EQ(cv::norm(read_only_mat(picture.view()), mat, cv::NORM_INF), 0);
  }
  EXPECT_THROW(Picture(cv::Mat(2, 2, CV_16UC1)), Error);
}

}  // namespace
}  // namespace relock
