#include "cli/video/shots.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace relock {
namespace {

/// Shots of a recording at 10 Hz, one letter a slot: # a frame, . one that was dropped, - none was recorded.
/// Told as "0 1 2f@0.30": a frame and f where it stands, with the time of those.
std::string shots(const std::string& letters, double from_s = 0, double to_s = 1e3) {
  Recording recording;
  recording.period = period_of(10);
  std::vector<bool> came;
  for (std::size_t slot = 0; slot < letters.size(); ++slot) {
    if (letters[slot] == '-') continue;
    recording.captured.push_back(Time{static_cast<std::int64_t>(slot) * recording.period});
    came.push_back(letters[slot] == '#');
  }
  std::string text;
  for (const Shot& shot : shots_of(recording, came, Time{from_seconds(from_s)}, Time{from_seconds(to_s)})) {
    text += fmt::format("{}{}", text.empty() ? "" : " ", shot.frame ? std::to_string(*shot.frame) : "none");
    if (shot.frozen) text += fmt::format("f@{:.1f}", seconds(shot.shown.time_since_epoch()));
  }
  return text;
}

TEST(Shots, AreTheFramesWhereAllCame) { EXPECT_EQ(shots("####"), "0 1 2 3"); }

TEST(Shots, StandWhereAFrameWasDropped) { EXPECT_EQ(shots("##..#"), "0 1 1f@0.2 1f@0.3 4"); }

TEST(Shots, StandAtEverySlotOfAGapOfTheRecording) { EXPECT_EQ(shots("##--#"), "0 1 1f@0.2 1f@0.3 2"); }

TEST(Shots, StandLongerWhereBothMeet) { EXPECT_EQ(shots("#.-.#"), "0 0f@0.1 0f@0.2 0f@0.3 3"); }

TEST(Shots, SayThatNothingCameYet) { EXPECT_EQ(shots(".##"), "nonef@0.0 1 2"); }

TEST(Shots, AreThoseOfAPart) { EXPECT_EQ(shots("######", .15, .42), "2 3 4"); }

TEST(Shots, OfAPauseAreNotWithoutEnd) {
  Recording recording;
  recording.period = period_of(100);
  recording.captured = {Time{}, Time{from_seconds(3600)}};
  const auto all = shots_of(recording, {true, true}, Time{}, recording.captured.back());
  EXPECT_LE(all.size(), 602u);
  EXPECT_GT(all.size(), 500u);
}

TEST(Shots, RiseInTimeAndHoldEveryFrameAtItsTime) {
  Recording recording;  // times that jitter by almost half a slot
  recording.period = period_of(30);
  std::vector<bool> came;
  for (std::int64_t i = 0; i < 200; ++i) {
    if (i % 7 == 3 || i % 11 == 5) continue;
    recording.captured.push_back(Time{i * recording.period + Duration((i * 7919 % 29 - 14) * 1'000'000)});
    came.push_back(i % 5 != 2);
  }
  const auto all = shots_of(recording, came, recording.captured.front(), recording.captured.back());
  std::size_t frames = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) {
      EXPECT_LT(all[i - 1].shown, all[i].shown);
    }
    if (frames < recording.frames() && all[i].shown == recording.captured[frames]) ++frames;
  }
  EXPECT_EQ(frames, recording.frames());
}

}  // namespace
}  // namespace relock
