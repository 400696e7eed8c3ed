#include "eval/loss_text.h"

#include <gtest/gtest.h>

#include "tests/eval/made_flight.h"

namespace relock {
namespace {

/// The words for the first loss of a tracker on a target that is always visible: g given, H right, S wrong, M
/// silent, . dropped.
struct Words {
  std::string onset, end, arrival, said;
};
Words words(const std::string& letters) {
  Recording recording = made_flight(std::string(letters.size(), 'v'));
  for (TargetTruth& truth : recording.truth) truth.blur = Vec2{3, 4}, truth.tilt_deg = 20.4;
  const Trajectory trajectory = said(recording, letters);
  const Loss loss = evaluate(recording, trajectory).targets[0].losses.at(0);
  const Circumstances c = circumstances(recording, trajectory, 0, loss);
  return {onset_text(recording, loss, c, gap_note(c)), end_text(recording, loss), arrival_text(c),
          said_text(loss)};
}

TEST(LossText, SaysWhenAndWhoseGapItWas) {
  EXPECT_EQ(words("gHHHHHMMMHHH").onset, "lost, and said so, at 0.17 s");
  EXPECT_EQ(words("gHHHHH..SSSS").onset, "lost silently at 0.17-0.27 s, over a gap of 3 slots (2 injected)");
}

TEST(LossText, SaysWhatTheTargetLookedLikeOnArrival) {
  EXPECT_EQ(words("gHHHHH..SSSS").arrival,
            "40 px large, blurred over 5.0 px, 0.07 D from where it was before, 100 px from the border, "
            "tilted by 20 "
            "degrees");
}

TEST(LossText, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(arrival_text({}), "");
  Circumstances cut;
  cut.border_px = -7;
  EXPECT_EQ(arrival_text(cut), "7 px over the border");
  EXPECT_EQ(gap_note({}), "");
}

TEST(LossText, SaysWhatWasSaidMeanwhileIsolatedHitsAside) {
  EXPECT_EQ(words("gHHSSSMHM").said, "a wrong place on 3 frames and nothing on 2");
  EXPECT_EQ(words("gHHMMMHHH").said, "nothing on 3 frames");
}

TEST(LossText, SaysHowItEnded) {
  EXPECT_EQ(words("gHHMMMHHH").end, "recovered in 0.13 s");
  EXPECT_EQ(words("gHHMMMgHH").end, "started again after 0.13 s");
  EXPECT_EQ(words("gHHMMMM").end, "not recovered in 0.13 s");
}

TEST(Joined, ReadsAloud) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"a"}), "a");
  EXPECT_EQ(joined({"a", "b", "c"}), "a, b and c");
}

}  // namespace
}  // namespace relock
