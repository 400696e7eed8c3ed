#include "core/truth.h"

#include <gtest/gtest.h>

#include "tests/fault.h"

namespace relock {
namespace {

TEST(LabelSource, IsTheSameAfterWritingAndReading) {
  for (const char* text : {"", "hand", "spline", "detector ring", "spline detector aruco+ring-paper"})
    EXPECT_EQ(to_string(parse_label_source(text)), text);
  EXPECT_EQ(to_string(parse_label_source("detector ring+aruco")), "detector aruco+ring") << "sorted";
}

TEST(LabelSource, OfADetectorIsOnesOwnInEveryCombinationWithIt) {
  const LabelSource label = parse_label_source("detector ring");
  for (const char* method : {"ring", "ring(max_blur=2)", "hybrid(ring,kcf)", "guarded(gap-aware(kcf),ring)"})
    EXPECT_TRUE(stems_from(label, method)) << method;
  for (const char* method : {"ring-paper", "string", "kcf", "hybrid(ring-paper,kcf)", ""})
    EXPECT_FALSE(stems_from(label, method)) << method;
  EXPECT_TRUE(stems_from(parse_label_source("spline detector aruco+ring"), "ring"))
      << "the curve goes through its answers";
  EXPECT_FALSE(stems_from(parse_label_source("spline"), "spline"));
  EXPECT_FALSE(stems_from({}, "ring"));
}

}  // namespace
}  // namespace relock
