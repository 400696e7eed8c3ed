#include "detectors/ring/reading.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/detectors/drawn_ring.h"
#include "tests/detectors/drawn_rings.h"

namespace relock::ring {
namespace {

const DrawnRing kRing{{118.4, 121.7}, 55, {18, 9}};

cv::Mat1b drawn(const std::string& bits) {
  cv::Mat1b picture(240, 240, std::uint8_t{128});
  draw(picture, {paper_ring_geometry(), bits}, kRing);
  add_noise(picture, 2, 4);
  return picture;
}

/// A coarse fit that is a pixel off.
Fit nearly() {
  Fit fit;
  fit.view = straight_on({119.2, 121}, 54.3);
  fit.view.blur = {17, 10};
  fit.light = {30, 180, 0};
  return fit;
}

TEST(RingReading, SaysTheBitsWhateverTheCodeThatTheCoarseFitTookForGranted) {
  RingModel model(paper_ring_geometry());
  Fitter fitter(model);
  for (std::size_t code = 0; code < model.codes(); ++code) {
    Pyramid pyramid;
    const cv::Mat1b picture = drawn(all_ring_bits(2)[code]);
    pyramid.build(picture);
    const auto reading = read(pyramid, fitter, nearly(), {});
    ASSERT_TRUE(reading) << code;
    EXPECT_EQ(reading->code, code);
    EXPECT_NEAR(reading->fit.view.centre.x(), kRing.centre.x, 0.1);
    EXPECT_NEAR(reading->fit.view.centre.y(), kRing.centre.y, 0.1);
    EXPECT_LT(reading->doubt, 0.05);
    ASSERT_EQ(reading->lights.size(), 4U);
  }
}

TEST(RingReading, IsNoneWhenItIsNotGoodEnough) {
  RingModel model(paper_ring_geometry());
  Fitter fitter(model);
  Pyramid pyramid;
  const cv::Mat1b picture = drawn("10");
  pyramid.build(picture);
  const auto reading = read(pyramid, fitter, nearly(), {});
  ASSERT_TRUE(reading);
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {.most_misfit = 0.9 * reading->fit.misfit}));
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {.most_doubt = 0.9 * reading->doubt}));
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {.least_gain = 250}));
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {.most_structure = 0, .structure_per_blur = 0}));
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {.most_together = 0.01}));
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {.least_black = 60}));
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {.most_white = 150}));
}

// A few bent edges at the picture's border are soon explained as part of a marker.
TEST(RingReading, OfAMarkerThatIsMostlyOutOfThePictureMustExplainMore) {
  RingModel model(paper_ring_geometry());
  Fitter fitter(model);
  const cv::Mat1b whole = drawn("10");
  const auto misfit_of = [&](int rows) {
    Pyramid pyramid;
    pyramid.build(whole.rowRange(0, rows));
    const auto reading = read(pyramid, fitter, nearly(), {});
    return reading ? std::optional(reading->fit.misfit) : std::nullopt;
  };
  const auto read_at_most = [&](int rows, double most_misfit) {
    Pyramid pyramid;
    pyramid.build(whole.rowRange(0, rows));
    return read(pyramid, fitter, nearly(), {.most_misfit = most_misfit}).has_value();
  };
  const auto misfit = misfit_of(130), of_all = misfit_of(240);
  ASSERT_TRUE(misfit && of_all);
  EXPECT_TRUE(read_at_most(240, 1.1 * *of_all));
  EXPECT_FALSE(read_at_most(130, 1.1 * *misfit));
}

TEST(RingReading, IsNoneWhereThereIsNoMarker) {
  RingModel model(paper_ring_geometry());
  Fitter fitter(model);
  Pyramid pyramid;
  cv::Mat1b noise(240, 240, std::uint8_t{128});
  add_noise(noise, 30, 2);
  pyramid.build(noise);
  EXPECT_FALSE(read(pyramid, fitter, nearly(), {}));
}

}  // namespace
}  // namespace relock::ring
