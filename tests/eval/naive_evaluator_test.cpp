#include "tests/eval/naive_evaluator.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace relock {
namespace {

// A target of 40 px that stays at (100, 60), at 10 Hz, and what was said of it, one letter a frame:
// H Hit, s held off-centre, S a wrong place, W a wrong code, M nothing, g Given, . dropped, - skipped,
// F absent but claimed, r absent and not claimed, ? unlabelled, ' ' not started.
// '|' is no frame: 6 s pass.
struct Timeline {
  Recording recording;
  Trajectory trajectory;
};

Sighting at(double x, double y) { return sighting_of(Box{x - 20, y - 20, 40, 40}); }

Timeline timeline(const std::string& letters) {
  Timeline made;
  made.recording.picture = {200, 150};
  made.recording.period = std::chrono::milliseconds(100);
  made.recording.targets = {{"a", Code{"dot", "1"}, {}}};
  made.trajectory.reads_codes = true;
  made.trajectory.judged_from = {0};
  made.trajectory.failed_from = {std::nullopt};
  Time now = time_ns(0);
  for (const char letter : letters) {
    if (letter == '|') {
      now += std::chrono::seconds(6);
      continue;
    }
    if (letter == ' ') ++*made.trajectory.judged_from[0];
    TargetTruth truth;
    truth.label = letter == '?'                    ? Label::unlabelled
                  : letter == 'F' || letter == 'r' ? Label::absent
                                                   : Label::visible;
    if (truth.label == Label::visible) truth.outline = Box{80, 40, 40, 40};
    FrameReport report;
    if (letter == '.') report.delivery = Delivery::dropped;
    if (letter == '-') report.delivery = Delivery::skipped;
    if (letter == 'g') report.given = {0};
    if (letter == 'H') report.sightings = {at(103, 60)};
    if (letter == 's') report.sightings = {at(100, 75)};
    if (letter == 'S') report.sightings = {at(20, 60)};
    if (letter == 'W') report.sightings = {at(103, 60)}, report.sightings[0].code = Code{"dot", "2"};
    if (letter == 'F') report.sightings = {at(20, 60)}, report.sightings[0].code = Code{"dot", "1"};
    made.recording.captured.push_back(now);
    made.recording.truth.push_back(truth);
    made.trajectory.frames.push_back(report);
    now += made.recording.period;
  }
  return made;
}

TargetTimeline told(const std::string& letters) {
  const Timeline made = timeline(letters);
  return naive::evaluate(made.recording, made.trajectory, Gate{}).targets[0];
}
// n not started, s searching, L locked, x lost, o out.
std::string states(const std::string& letters) {
  std::string line;
  for (const State state : told(letters).states) line += "nsLxo"[static_cast<std::size_t>(state)];
  return line;
}
Loss only_loss(const std::string& letters) {
  const auto losses = told(letters).losses;
  EXPECT_EQ(losses.size(), 1U) << letters;
  return losses.empty() ? Loss{} : losses.front();
}
Scores scores(const std::string& letters) {
  const Timeline made = timeline(letters);
  return naive::score(made.recording, made.trajectory,
                      naive::evaluate(made.recording, made.trajectory, Gate{}))
      .pooled;
}

TEST(NaiveEvaluator, GivesTheVerdictsThatTheLettersMean) {
  const std::string letters = " gHWSM.-?Fr";
  const Verdict expected[] = {Verdict::NotStarted, Verdict::Given,        Verdict::Hit,
                              Verdict::WrongId,    Verdict::Stray,        Verdict::Miss,
                              Verdict::Dropped,    Verdict::Skipped,      Verdict::Unlabelled,
                              Verdict::FalseAlarm, Verdict::CorrectReject};
  const auto target = told(letters);
  for (std::size_t k = 0; k < letters.size(); ++k) EXPECT_EQ(target.judgements[k].verdict, expected[k]) << k;
  EXPECT_TRUE(told("s").judgements[0].hold);
}

TEST(NaiveEvaluator, LocksAtTheFirstOfThreeHits) {
  EXPECT_EQ(states("  MHHH"), "nnsLLL");
  EXPECT_EQ(states("HH"), "ss");
  EXPECT_EQ(states("HHMHH"), "sssss");
  EXPECT_EQ(states("H.H-?H"), "LLLLLL");  // what is not scored breaks no run
}
TEST(NaiveEvaluator, DeclaresALossAtTheThirdFrameThatDoesNotHold) {
  EXPECT_EQ(states("gHHHMMM"), "LLLxxxx");
  const Loss loss = only_loss("gHHHMMM");
  EXPECT_EQ(loss.rule, LossRule::a);
  EXPECT_EQ(loss.kind, LossKind::Declared);
  EXPECT_EQ(loss.last_good, 3);
  EXPECT_EQ(loss.first_lost, 4);
  EXPECT_EQ(loss.declared, 6);
  EXPECT_EQ(loss.end, LossEnd::recording_stopped);
}
TEST(NaiveEvaluator, CreditsALockUpToItsLastHoldHoweverItEnds) {
  EXPECT_EQ(states("gHHMM"), "LLsss");
  EXPECT_EQ(states("gHHMMrH"), "LLsssos");
  EXPECT_TRUE(told("gHHMM").losses.empty());
}
TEST(NaiveEvaluator, KeepsALockThroughIsolatedMissesAndThroughGaps) {
  EXPECT_EQ(states("gHMMHMMH"), "LLLLLLLL");
  EXPECT_EQ(states("gH.....H"), "LLLLLLLL");
}
TEST(NaiveEvaluator, RecoversAtTheFirstHitOfTheNextLock) {
  const Loss loss = only_loss("gHHMMMHMHHH");
  EXPECT_EQ(loss.end, LossEnd::recovered);
  EXPECT_EQ(loss.end_frame, 8);
  EXPECT_EQ(loss.said, (std::array<int, 4>{0, 0, 0, 4}));  // the isolated Hit aside
  EXPECT_EQ(states("gHHMMMHMHHH"), "LLxxxxxxLLL");
}
TEST(NaiveEvaluator, CallsALossByWhatWasSaidMost) {
  EXPECT_EQ(only_loss("gHHSSSMM").kind, LossKind::Silent);
  EXPECT_EQ(only_loss("gHHWWWSM").kind, LossKind::WrongId);
  EXPECT_EQ(only_loss("gHHSMSM").kind, LossKind::Silent);  // a tie
}
TEST(NaiveEvaluator, DeclaresDriftAfterASecondOffCentre) {
  EXPECT_EQ(states("gHssssssssss"), "LLLLLLLLLLLL");  // 0.9 s from the first of them to the last
  const Loss loss = only_loss("gHsssssssssss");
  EXPECT_EQ(loss.rule, LossRule::b);
  EXPECT_EQ(loss.kind, LossKind::Drift);
  EXPECT_EQ(loss.last_good, 1);
  EXPECT_EQ(loss.declared, 12);
}
TEST(NaiveEvaluator, CensorsALossWhenTheTargetLeavesOrIsGivenOrLabelsStop) {
  EXPECT_EQ(only_loss("gHHMMMMr").end, LossEnd::target_left);
  EXPECT_EQ(only_loss("gHHMMMMr").end_frame, 6);
  EXPECT_EQ(only_loss("gHHMMM.g").end, LossEnd::reset);
  EXPECT_EQ(only_loss("gHHMMM.g").end_frame, 7);
  EXPECT_EQ(only_loss("gHHMMM|M").end, LossEnd::labels_stopped);
  EXPECT_EQ(only_loss("gHHMMM?????M").end, LossEnd::labels_stopped);
  EXPECT_EQ(only_loss("gHHMMM????M").end, LossEnd::recording_stopped);  // 0.5 s is not more than 0.5 s
}
TEST(NaiveEvaluator, KeepsALockOverAPauseOnlyWhenItLastHeld) {
  EXPECT_EQ(states("gHH|MH"), "LLLLL");
  EXPECT_EQ(states("gHHM|HM"), "LLssss");
}
TEST(NaiveEvaluator, IsOutWhileTheTargetIsAwayAndSearchesWhenItReturns) {
  EXPECT_EQ(states("gHHrrMHHH"), "LLLoosLLL");
  const auto searches = told("gHHrrMHHH").acquisitions;
  ASSERT_EQ(searches.size(), 1U);
  EXPECT_EQ(searches[0], (Acquisition{Acquisition::Kind::reacquire, 5, 6}));
}
TEST(NaiveEvaluator, CallsItChanceWhenTheTargetComesToTheReport) {
  Timeline made = timeline("HHHHHHHHHHHHHHHHH");
  const double places[] = {100, 100, 100, 130, 140, 150, 160, 150, 140,
                           130, 120, 110, 105, 102, 100, 100, 100};
  for (std::size_t k = 0; k < made.recording.truth.size(); ++k)
    made.recording.truth[k].outline = Box{places[k] - 20, 40, 40, 40};
  const auto losses = naive::evaluate(made.recording, made.trajectory, Gate{}).targets[0].losses;
  ASSERT_EQ(losses.size(), 1U);
  EXPECT_EQ(losses[0].end, LossEnd::chance);
  EXPECT_EQ(losses[0].end_frame, 11);
}

TEST(NaiveEvaluator, PrefersMoreHitsToANearerPair) {
  Timeline made = timeline("M");
  made.recording.targets = {{"a", {}, {}}, {"b", {}, {}}};
  made.recording.truth = {made.recording.truth[0], made.recording.truth[0]};
  made.recording.truth[1].outline = Box{92, 40, 40, 40};  // 12 px to the right
  made.trajectory.judged_from = {0, 0};
  made.trajectory.failed_from.resize(2);
  made.trajectory.frames[0].sightings = {at(102, 60), at(91, 60)};
  const auto targets = naive::evaluate(made.recording, made.trajectory, Gate{}).targets;
  EXPECT_EQ(targets[0].judgements[0].sighting, 1);
  EXPECT_EQ(targets[1].judgements[0].sighting, 0);
  EXPECT_EQ(targets[1].judgements[0].verdict, Verdict::Hit);
}
TEST(NaiveEvaluator, CountsASecondAnswerAtThePlaceAsSpurious) {
  Timeline made = timeline("H");
  made.trajectory.frames[0].sightings.push_back(at(101, 60));
  const Evaluation evaluation = naive::evaluate(made.recording, made.trajectory, Gate{});
  EXPECT_EQ(evaluation.spurious[0], 1);
  EXPECT_EQ(evaluation.targets[0].judgements[0].sighting, 1);  // the nearer one
}
TEST(NaiveEvaluator, RefusesSightingsOnFramesThatWereNotDelivered) {
  Timeline made = timeline("H.");
  made.trajectory.frames[1].sightings = {at(100, 60)};
  EXPECT_THROW(naive::evaluate(made.recording, made.trajectory, Gate{}), Error);
}

TEST(NaiveScores, DivideVisibleTimeIntoLockedLostAndSearching) {
  const Scores s = scores(" MHHHMMMMHHH");
  EXPECT_NEAR(s.visible_s, 1.0, 1e-12);
  EXPECT_NEAR(s.searching_s, 0.1, 1e-12);
  EXPECT_NEAR(s.locked_s, 0.4, 1e-12);
  EXPECT_NEAR(s.lost_s, 0.5, 1e-12);
  EXPECT_NEAR(*s.recovery.median_s, 0.5, 1e-12);
  EXPECT_NEAR(*s.losses_per_minute, 150, 1e-9);
}
TEST(NaiveScores, LowerAvailabilityByALongGapEvenWhenBothEndsAreHits) {
  EXPECT_NEAR(*scores("gHHHHHH").availability, 1.0, 1e-12);
  EXPECT_NEAR(*scores("gHH...H").availability, 0.4, 1e-12);  // 0.1 + 0.1 of 0.5 s
  EXPECT_NEAR(*scores("gHH...H").availability_of_ceiling, 1.0, 1e-12);
}
TEST(NaiveScores, AreOneForAPerfectMethodAndZeroForAMuteOne) {
  const Scores perfect = scores("gHHHHrrHHHHH"), mute = scores(" MMMMrrMMMMM");
  EXPECT_EQ(perfect.recognition, 1.0);
  EXPECT_EQ(perfect.precision, 1.0);
  EXPECT_NEAR(*perfect.availability_of_ceiling, 1.0, 1e-12);
  EXPECT_NEAR(*perfect.locked_share_of_ceiling, 1.0, 1e-12);
  for (const auto& zero :
       {mute.recognition, mute.precision, mute.availability_of_ceiling, mute.locked_share_of_ceiling})
    EXPECT_EQ(zero, 0.0);
}
TEST(NaiveScores, CallASkippedFrameNotAHit) { EXPECT_EQ(scores("gH-H-.").recognition, 0.5); }

}  // namespace
}  // namespace relock
