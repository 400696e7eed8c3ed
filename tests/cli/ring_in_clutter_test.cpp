// What ring makes of the simulator's clutter: nothing where no marker is, and the marker where one is.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "cli/print/targets.h"
#include "core/opencv.h"
#include "detectors/ring.h"
#include "sequences/simulator/clutter.h"
#include "sequences/simulator/stills.h"

namespace relock {
namespace {

using namespace simulator;

TEST(RingInClutter, ReadsNothingOnAPosterOfAnyKind) {
  const auto detector = ring_detector({});
  for (const Print print : {Print::circles, Print::target, Print::blinds, Print::grid, Print::text,
                            Print::checkerboard, Print::crosses, Print::landscape})
    for (const std::uint64_t seed : {2U, 4U, 6U}) {
      const Canvas canvas = poster(print, {0.8, 0.6}, 500, Random(seed));
      cv::Mat1b grey, moved;
      cv::cvtColor(canvas.picture, grey, cv::COLOR_BGR2GRAY);
      EXPECT_TRUE(detector->detect(view(grey)).empty()) << static_cast<int>(print) << " " << seed;
      cv::blur(grey, moved, {19, 1});
      EXPECT_TRUE(detector->detect(view(moved)).empty()) << static_cast<int>(print) << " blurred " << seed;
    }
}

TEST(RingInClutter, ReadsNothingWhereNoMarkerIs) {
  for (const std::string geometry : {"paper", "even"}) {
    const auto detector = ring_detector({.geometry = geometry});
    const StillPlan plan{.shown = 0, .blurs_px = {0, 15, 30, 60}};
    for (std::size_t rank = 0; rank < 12; ++rank)
      EXPECT_TRUE(detector->detect(view(still(plan, {}, rank, 2).pixels)).empty()) << geometry << rank;
  }
}

/// How many of the stills are read right; none may be read wrong.
int read_right(const StillPlan& plan, std::size_t stills, const RingOptions& options = {}) {
  const auto detector = ring_detector(options);
  std::vector<PrintedTarget> targets;
  for (const char* name : {"ring:00", "ring:01", "ring:10", "ring:11"})
    targets.push_back(print_target(name, 0.15));
  int right = 0;
  for (std::size_t rank = 0; rank < stills; ++rank) {
    const Still shown = still(plan, targets, rank, 4);
    const auto found = detector->detect(view(shown.pixels));
    EXPECT_LE(found.size(), 1U) << rank;
    for (const Sighting& one : found) {
      EXPECT_EQ(one.code, targets[*shown.shown].code) << rank;
      EXPECT_LT(norm(one.centre - *shown.targets[*shown.shown].centre_projected), 2) << rank;
      ++right;
    }
  }
  return right;
}

TEST(RingInClutter, ReadsSmallMarkers) {
  EXPECT_GE(read_right({.size_px = {24, 30}, .tilt_deg = {0, 20}}, 16), 15);
}

TEST(RingInClutter, ReadsMarkersThatAreFarTilted) {
  EXPECT_GE(read_right({.size_px = {150, 150}, .tilt_deg = {60, 68}}, 12), 11);
}

TEST(RingInClutter, ReadsMarkersBlurredByTwoThirdsOfTheirSize) {
  EXPECT_GE(read_right({.size_px = {150, 150}, .blurs_px = {80, 100}}, 12), 11);
}

// What a camera's sensor averages is light; pictures code it.
TEST(RingInClutter, ReadsMarkersWhoseLightWasBlurred) {
  const StillPlan plan{.size_px = {100, 150}, .blurs_px = {20, 50}, .blur_in = BlurIn::light};
  EXPECT_GE(read_right(plan, 12), 11);
  EXPECT_GE(read_right(plan, 12, {.tone = RingTone::light}), 11);
  EXPECT_LE(read_right(plan, 12, {.tone = RingTone::coded}), 8);  // what the others would miss
}

}  // namespace
}  // namespace relock
