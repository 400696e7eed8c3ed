#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

// What the paper publishes: Prasad, Chandran and Brown, "A Motion Blur Resilient Fiducial for Quadcopter Imaging"
// (WACV 2015), figure by figure. Nothing here is measured by relock.

namespace relock::reproduction::paper {

/// A recognition rate at a length of blur.
struct RateAtBlur {
  double blur_px = 0;
  double percent = 0;
};
/// A marker and its rates, as far as they are printed.
struct PublishedRates {
  std::string_view name;
  std::vector<RateAtBlur> rates;

  /// Nothing where the paper prints none.
  std::optional<double> at(double blur_px) const;
};

/// Figure 3, the table: square markers of 150 x 150 px, blurred over all orientations.
const PublishedRates& pitag();
const PublishedRates& artag();

/// Section 4.1 and figure 11: the rings on the same canvas, by code. "Even under more severe blur, of 65 pixels,
/// the algorithm is successful. Our recognition is 100% for all codes except the "00" which is undetectable after
/// 50 pixels blur". From 15 px, where the experiment it repeats begins, in steps of 5 px.
const PublishedRates& ring(std::string_view code);
/// Section 4.1: from here on 00 is left out of table 1, "since the pattern cannot be detected".
constexpr double kZerosLeftOutFrom_px = 50;

/// Table 1: error of the centre, px, over blur of 30 to 65 px in steps of 5 and all codes.
struct CentreError {
  double angle_deg = 0;
  double mean_px = 0, deviation_px = 0;
};
const std::array<CentreError, 5>& centre_errors();
/// The text to it: "the mean error in locating center by our algorithm is within approximate 3 pixels".
constexpr double kMeanErrorWithin_px = 3;

/// Table 2: four recordings of "roughly two minutes", a ring beside two ARTags.
struct RecordedTest {
  int number = 0;
  int frames = 0;
  std::string_view code;
  double artag_percent = 0, ring_percent = 0;
};
const std::array<RecordedTest, 4>& recorded_tests();

/// Figure 12 and section 4.2: round a box with a marker on each side.
struct BoxFlight {
  double ring_percent = 90;
  double artag_percent = 60;  ///< "only around 60%"
};
constexpr BoxFlight kBoxFlight;

/// Sections 4 and 5: "Our detection process takes around 0.3 seconds".
constexpr double kSecondsPerFrame = 0.3;

}  // namespace relock::reproduction::paper
