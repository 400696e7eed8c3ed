#include "eval/timeline_text.h"

#include <gtest/gtest.h>

#include "tests/eval/made_flight.h"

namespace relock {
namespace {

struct Told {
  std::string lane, story;
};

/// The lane and story of a tracker on a target that is always visible: g given, H right, S wrong, M silent, .
/// dropped.
Told told(const std::string& letters, int columns = 100, std::int64_t slots_a_frame = 1) {
  Recording recording = made_flight(std::string(letters.size(), 'v'));
  for (std::size_t i = 0; i < letters.size(); ++i)
    recording.captured[i] = Time{static_cast<std::int64_t>(i) * slots_a_frame * recording.period};
  const Trajectory trajectory = said(recording, letters);
  const Evaluation evaluation = evaluate(recording, trajectory);
  return {lane(recording, evaluation.targets[0], {columns}), story(recording, trajectory, evaluation, 0)};
}

TEST(Lane, IsACharacterASlot) {
  EXPECT_EQ(told("gHHH..SSS").lane, "gHHH..SSS");
  EXPECT_EQ(told("gHHH", 100, 2).lane, "g.H.H.H") << "slots that were not recorded show as gaps";
}

TEST(Lane, ThatIsTooShortShowsTheMostFrequentVerdictAndAlwaysStarts) {
  EXPECT_EQ(told("gHHHHHMMMHHH", 4).lane, "gHMH");
}

TEST(Story, TellsALossWithItsGapAndThatItWasNotRecovered) {
  EXPECT_EQ(told("gHHH...SSSSSS").story,
            "lost silently at 0.10-0.23 s, over a gap of 4 slots; not recovered in 0.30 s");
}

TEST(Story, TellsHowLongItTookToRecover) {
  EXPECT_EQ(told("gHHHMMMMHHH").story, "lost, and said so, at 0.10 s; recovered in 0.17 s");
  EXPECT_EQ(told("gHHHMMMHHHHMMMHHH").story, "2 losses, recovered in 0.13 s and 0.13 s");
}

TEST(Story, OfAMethodThatKeptItsTargetSaysSo) { EXPECT_EQ(told("gHHHMHHH").story, "kept throughout"); }

}  // namespace
}  // namespace relock
