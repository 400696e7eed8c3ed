// What the toolkits' conventions come to, worked by hand. Agreement with what they compute themselves is tested
// in tests/cli/compatibility_test.cpp, where their files can be read.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "eval/compatibility/ape.h"
#include "eval/compatibility/got10k.h"
#include "eval/compatibility/otb.h"
#include "eval/compatibility/overlap.h"
#include "eval/compatibility/vot.h"
#include "eval/compatibility/vot_multistart.h"

namespace relock {
namespace {

constexpr Size kPicture{100, 80};
constexpr Box kTarget{19.5, 19.5, 20, 10};
const Box kElsewhere{69.5, 59.5, 20, 10};

/// One letter a frame: g given, H the truth is said, h the half of it (overlap 0.5), S elsewhere, . nothing said.
AnsweredSequence answers(const std::string& letters, const Box& truth = kTarget) {
  AnsweredSequence sequence{"made", kPicture, 0, {}};
  for (const char letter : letters) {
    AnsweredFrame frame{truth, 1, letter == 'g', {}};
    if (letter == 'g' || letter == 'H') frame.answer = truth;
    if (letter == 'h') frame.answer = Box{truth.x, truth.y, truth.width / 2, truth.height};
    if (letter == 'S') frame.answer = kElsewhere;
    sequence.frames.push_back(frame);
  }
  return sequence;
}

OtbScores otb(const AnsweredSequence& sequence) { return otb_scores(std::vector{sequence}); }
Got10kScores got10k(const AnsweredSequence& sequence) { return got10k_scores(std::vector{sequence}); }

TEST(OtbConvention, GivesAPerfectMethodTwentyOf21BecauseNoOverlapIsGreaterThanOne) {
  EXPECT_DOUBLE_EQ(otb(answers("gHHHH")).auc.value(), 20.0 / 21);
  EXPECT_DOUBLE_EQ(otb(answers("gHHHH")).precision_20.value(), 1);
}

TEST(OtbConvention, CountsTheFirstFrameAsPerfectWhateverWasSaid) {
  AnsweredSequence sequence = answers("SSSS");
  EXPECT_DOUBLE_EQ(otb(sequence).success_rate.value(), 0.25);
}

TEST(OtbConvention, LetsTheLastAnswerStandWhereNothingIsSaid) {
  EXPECT_EQ(otb(answers("gHS..H")).success, otb(answers("gHSSSH")).success);
  EXPECT_DOUBLE_EQ(otb(answers("gHS..H")).success_rate.value(), 0.5);
}

TEST(OtbConvention, NeverCountsAnOverlapThatEqualsTheThreshold) {
  const OtbScores scores = otb(answers("ghhh"));
  EXPECT_DOUBLE_EQ(scores.success[9], 1);      // > 0.45
  EXPECT_DOUBLE_EQ(scores.success[10], 0.25);  // > 0.5: the first frame alone
}

TEST(OtbConvention, CallsFramesWithoutAnAnnotationPreciseAndNoSuccess) {
  AnsweredSequence absent = answers("gHHH");
  absent.frames[2].truth.reset();
  EXPECT_DOUBLE_EQ(otb(absent).success[0], 0.75);
  EXPECT_DOUBLE_EQ(otb(absent).precision[0], 1);
  const AnsweredSequence over_the_border = answers("gHHH", {-3, 20, 20, 10});
  EXPECT_DOUBLE_EQ(otb(over_the_border).success[0], 0);
  EXPECT_DOUBLE_EQ(otb(over_the_border).precision[0], 1);
}

TEST(OtbConvention, AveragesCurvesOverSequencesOfAnyLength) {
  const std::vector all{answers("gHHHHHHHHH"), answers("gS")};
  EXPECT_DOUBLE_EQ(otb_scores(all).success_rate.value(), 0.75);
  EXPECT_FALSE(otb_scores({}).auc);
}

TEST(Got10kConvention, LeavesOutTheFirstFrameAndWhatIsNotVisible) {
  AnsweredSequence sequence = answers("gHSS");
  sequence.frames[2].visible_fraction = 0;
  sequence.frames[3].truth.reset();
  EXPECT_EQ(got10k(sequence).frames, 1u);
  EXPECT_DOUBLE_EQ(got10k(sequence).ao.value(), 1);
  EXPECT_FALSE(got10k(answers("g")).ao);
}

TEST(Got10kConvention, OverlapsByNothingWhereNothingIsSaid) {
  EXPECT_DOUBLE_EQ(got10k(answers("gH..H")).ao.value(), 0.5);
}

TEST(Got10kConvention, PoolsFramesNotSequences) {
  const std::vector all{answers("gHHHHHHHHH"), answers("gS")};
  EXPECT_DOUBLE_EQ(got10k_scores(all).ao.value(), 0.9);
}

TEST(Got10kConvention, MovesALeftEdgeIntoThePictureAndKeepsTheWidth) {
  // 1-based left edges -9 and 0: both become 0, so boxes that share half of their area are the same.
  EXPECT_DOUBLE_EQ(got10k_overlap({-10.5, 10, 20, 10}, {-1.5, 10, 20, 10}, kPicture), 1);
  EXPECT_LT(otb_overlap({-10.5, 10, 20, 10}, {-1.5, 10, 20, 10}), 0.4);
  // Beyond the right border both have no width left, and no overlap.
  EXPECT_DOUBLE_EQ(got10k_overlap({110, 10, 20, 10}, {110, 10, 20, 10}, kPicture), 0);
}

Quad quad_of(const Box& b) {
  return {{Vec2{b.x, b.y}, Vec2{b.right(), b.y}, Vec2{b.right(), b.bottom()}, Vec2{b.x, b.bottom()}}};
}

TEST(VotOverlap, CountsAPolygonAPixelLargerThanTheBoxOfItsCorners) {
  EXPECT_DOUBLE_EQ(vot_overlap(kTarget, kTarget, kPicture), 1);
  EXPECT_DOUBLE_EQ(vot_overlap(quad_of(kTarget), quad_of(kTarget), kPicture), 1);
  EXPECT_DOUBLE_EQ(vot_overlap(kTarget, quad_of(kTarget), kPicture), 200.0 / (21 * 11));
}

TEST(VotOverlap, LooksOnlyAtThePicture) {
  // Two boxes, 20 and 10 px wide, of which the same 5 columns are in the picture.
  EXPECT_DOUBLE_EQ(vot_overlap(Box{-15.5, 10, 20, 10}, Box{-5.5, 10, 10, 10}, kPicture), 1);
  EXPECT_DOUBLE_EQ(vot_overlap(Box{200, 10, 20, 10}, Box{200, 10, 20, 10}, kPicture), 0);
}

TEST(VotOverlap, RoundsToWholePixelsTiesToEven) {
  // From the corner: left edges 20.5 and 20 are both 20, 21.5 is 22.
  EXPECT_DOUBLE_EQ(vot_overlap(Box{20, 19.5, 20, 10}, kTarget, kPicture), 1);
  EXPECT_DOUBLE_EQ(vot_overlap(Box{21, 19.5, 20, 10}, kTarget, kPicture), 18.0 / 22);
}

TEST(VotOverlap, OfAnEllipseIsThatOfTheBoxAroundIt) {
  const Ellipse ellipse{{29.5, 24.5}, 10, 5, 0};
  EXPECT_DOUBLE_EQ(vot_overlap(ellipse, kTarget, kPicture), 1);
}

std::string letters_of(const std::vector<VotCode>& codes) {
  std::string text;
  for (const VotCode code : codes) text += "012r"[static_cast<std::size_t>(code)];
  return text;
}

std::string codes(const std::string& letters) { return letters_of(vot_codes(answers(letters))); }

TEST(VotCodes, HaveAFailureOnTheFirstFrameWithoutOverlapAndNothingUpToTheNextStart) {
  EXPECT_EQ(codes("gHHSSSSSgHH"), "1rr200001rr");
  EXPECT_EQ(codes("gH......gHH"), "1r2000001rr");  // nothing said is no overlap
  EXPECT_EQ(codes("gHHHS"), "1rrr2");
  EXPECT_EQ(codes("gHHHSHH"), "1rrr200");  // back by itself, but it had failed
}

TEST(VotCodes, PutAFailureThatOnlyOthersSawFiveFramesBeforeTheStart) {
  EXPECT_EQ(codes("gHHHHHHHHgH"), "1rrr200001r");
}

TEST(VotCodes, HaveNothingAndNoFailureWhereNothingCanBeJudged) {
  AnsweredSequence sequence = answers("gHH.HS");
  sequence.frames[3].judged = false;
  EXPECT_EQ(letters_of(vot_codes(sequence)), "1rr0r2");
}

TEST(VotScores, LeaveOutTheBurnInAfterEveryStart) {
  const VotScores scores =
      vot_scores(std::vector{answers("g" + std::string(9, 'h') + "HHS....g" + std::string(9, 'h') + "H")});
  EXPECT_DOUBLE_EQ(scores.accuracy.value(), 1);
  EXPECT_EQ(scores.failures, 1u);
}

TEST(VotScores, TakeRobustnessAsTheChanceToLast30Frames) {
  const VotScores scores = vot_scores(std::vector{answers("g" + std::string(58, 'H') + "S")});
  EXPECT_DOUBLE_EQ(scores.robustness.value(), std::exp(-30.0 / 60));
}

TEST(VotScores, GoOnWithZerosBehindAFailureInTheExpectedOverlap) {
  // Fragments: start and two frames of overlap 1, failed; start and four frames of overlap 1, not failed.
  VotOptions options;
  options.eao_low = 3;
  options.eao_high = 4;
  const VotScores scores = vot_scores(std::vector{answers("gHHS....gHHHH")}, options);
  ASSERT_EQ(scores.expected_overlap.size(), 5u);
  EXPECT_DOUBLE_EQ(scores.expected_overlap[2], 1);
  EXPECT_DOUBLE_EQ(scores.expected_overlap[3], (2.0 / 3 + 1) / 2);
  EXPECT_DOUBLE_EQ(scores.expected_overlap[4], (2.0 / 4 + 1) / 2);
  EXPECT_DOUBLE_EQ(scores.eao.value(), (5.0 / 6 + 3.0 / 4) / 2);
  EXPECT_FALSE(vot_scores(std::vector{answers("gHHS....gHHHH")}).eao);  // no fragment of 100 frames
}

TEST(VotScores, TakeAFragmentThatDidNotFailOnlyAsFarAsItGoes) {
  const VotScores scores = vot_scores(std::vector{answers("ghh"), answers("gHHHH")});
  ASSERT_EQ(scores.expected_overlap.size(), 5u);
  EXPECT_DOUBLE_EQ(scores.expected_overlap[2], 0.75);
  EXPECT_DOUBLE_EQ(scores.expected_overlap[3], 1);
}

TEST(VotMultistartScores, CountARunUpToTheFirstOfTenMissesInARow) {
  const std::string nine(9, 'S'), ten(10, 'S');
  const VotMultistartScores back = vot_multistart_scores(std::vector{answers("gH" + nine + "H")});
  EXPECT_EQ(back.failures, 0u);
  EXPECT_DOUBLE_EQ(back.robustness.value(), 1);
  EXPECT_DOUBLE_EQ(back.accuracy.value(), 2.0 / 12);
  const VotMultistartScores lost = vot_multistart_scores(std::vector{answers("gHHH" + ten + "HH")});
  EXPECT_EQ(lost.failures, 1u);
  EXPECT_DOUBLE_EQ(lost.robustness.value(), 4.0 / 16);
  EXPECT_DOUBLE_EQ(lost.accuracy.value(), 3.0 / 4);
  EXPECT_FALSE(back.eao);  // not that long; what failed counts on with zeros
  EXPECT_LT(lost.eao.value(), 0.03);
}

TEST(VotMultistartScores, MissNothingWhereTheTargetIsNotThere) {
  AnsweredSequence sequence = answers("gH" + std::string(12, '.') + "H");
  sequence.frames[8].truth.reset();
  EXPECT_EQ(vot_multistart_scores(std::vector{sequence}).failures, 0u);
}

TEST(ApeScores, LeaveOutWhatWasGivenAndWhatWasNotAnswered) {
  const ApeScores scores = ape_scores(std::vector{answers("gHS..H")});
  EXPECT_EQ(scores.frames, 3u);
  EXPECT_DOUBLE_EQ(scores.max_px.value(), std::hypot(50, 40));
  EXPECT_DOUBLE_EQ(scores.rmse_px.value(), std::hypot(50, 40) / std::sqrt(3));
  EXPECT_FALSE(ape_scores(std::vector{answers("g..")}).rmse_px);
}

TEST(ApeScores, CannotAlignAPathThatDoesNotMove) {
  EXPECT_THROW(ape_scores(std::vector{answers("gHSHS")}, Alignment::rigid), Error);
}

Recording two_targets() {
  Recording recording{"two/of", kPicture, Duration{40'000'000}, {}, {{"a b"}, {"c"}}, {}};
  for (std::int64_t i = 0; i < 3; ++i) recording.captured.push_back(time_ns(40'000'000 * i));
  recording.truth.resize(6, {Label::visible, kTarget});
  return recording;
}

TEST(AnsweredSequences, AreOfOneTargetAndBeginWhereItsTrackerWasStarted) {
  const Recording recording = two_targets();
  Trajectory trajectory;
  trajectory.frames.resize(3);
  trajectory.judged_from = {FrameIndex{1}, std::nullopt};
  trajectory.frames[1].given = {0};
  Sighting own = sighting_of(kTarget), other = sighting_of(kElsewhere);
  own.track = "a b";
  other.track = "c";
  trajectory.frames[2].sightings = {other, own};
  const auto sequence = answers_for(recording, trajectory, 0);
  ASSERT_TRUE(sequence);
  EXPECT_EQ(sequence->name, "two-of-a-b");
  EXPECT_EQ(sequence->first_frame, 1u);
  ASSERT_EQ(sequence->frames.size(), 2u);
  EXPECT_TRUE(sequence->frames[0].given);
  EXPECT_EQ(sequence->frames[1].answer, std::optional<Outline>(kTarget));
  EXPECT_FALSE(answers_for(recording, trajectory, 1));
}

}  // namespace
}  // namespace relock
