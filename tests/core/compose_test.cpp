#include "core/compose.h"

#include <gtest/gtest.h>

namespace relock {
namespace {

/// Says the box it was started with, moved right by its number of starts.
class Numbered final : public Tracker {
 public:
  explicit Numbered(std::uint64_t number) : number_(number) {}
  void start(const Frame&, const Box& box) override { box_ = box; }
  std::optional<Sighting> track(const Frame&) override {
    Box box = box_;
    box.x += static_cast<double>(number_);
    return sighting_of(box);
  }

 private:
  std::uint64_t number_;
  Box box_;
};

TEST(TrackFromBox, FollowsEachTargetWithATrackerOfItsOwn) {
  const auto method = track_from_box([](std::uint64_t n) { return std::make_unique<Numbered>(n); });
  method->start({0, {}, {}}, {"left"}, {10, 0, 20, 20});
  method->start({0, {}, {}}, {"right"}, {50, 0, 20, 20});
  EXPECT_TRUE(method->locate({0, {}, {}}).empty()) << "on the frame of the start nothing is asked";
  const Sightings said = method->locate({1, {}, {}});
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].track, "left");
  EXPECT_EQ(said[1].track, "right");
  EXPECT_EQ(said[1].centre.x, 61);
}

TEST(TrackFromBox, StartsAgainWithANewTracker) {
  const auto method = track_from_box([](std::uint64_t n) { return std::make_unique<Numbered>(n); });
  method->start({0, {}, {}}, {"a"}, {10, 0, 20, 20});
  method->start({5, {}, {}}, {"a"}, {10, 0, 20, 20});
  EXPECT_EQ(method->locate({6, {}, {}}).at(0).centre.x, 21);
}

}  // namespace
}  // namespace relock
