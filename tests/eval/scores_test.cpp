// Scores worked by hand: metrics.md section 6.

#include "eval/scores/scores.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr auto kPeriod = std::chrono::milliseconds(100);

// A target of 40 px that stays at (100, 60), at 10 Hz, and what was said of it, one letter a frame:
// H a Hit, s held off-centre, S a box stuck elsewhere, W a wrong code, M nothing, g Given, . dropped,
// r absent, F absent but claimed. A digit is no frame: so many slots pass.
Case timeline(const std::string& letters) {
  Case made;
  Recording& recording = made.recording;
  recording.picture = {200, 150};
  recording.period = kPeriod;
  recording.targets = {{"a", Code{"dot", "1"}, {}}};
  made.trajectory.reads_codes = true;
  made.trajectory.judged_from = {0};
  made.trajectory.failed_from = {std::nullopt};
  Time now = time_ns(0);
  for (const char letter : letters) {
    if (letter >= '0' && letter <= '9') {
      now += (letter - '0') * kPeriod;
      continue;
    }
    const auto box_at = [](double x, double y) { return sighting_of(Box{x - 20, y - 20, 40, 40}); };
    TargetTruth truth;
    truth.label = letter == 'r' || letter == 'F' ? Label::absent : Label::visible;
    if (truth.label == Label::visible) truth.outline = Box{80, 40, 40, 40};
    FrameReport report;
    if (letter == '.') report.delivery = Delivery::dropped;
    if (letter == 'g') report.given = {0};
    if (letter == 'H' || letter == 'W') report.sightings = {box_at(103, 60)};
    if (letter == 's') report.sightings = {box_at(100, 75)};
    if (letter == 'S' || letter == 'F') report.sightings = {box_at(20, 60)};
    if (letter == 'W') report.sightings[0].code = Code{"dot", "2"};
    if (letter == 'F') report.sightings[0].code = Code{"dot", "1"};
    recording.captured.push_back(now);
    recording.truth.push_back(truth);
    made.trajectory.frames.push_back(report);
    now += kPeriod;
  }
  return made;
}

ScoreSheet sheet_of(const Case& c) {
  return score(c.recording, c.trajectory, evaluate(c.recording, c.trajectory));
}
Scores scores(const std::string& letters) { return sheet_of(timeline(letters)).pooled; }

// --- Fix age.

TEST(FixAge, GrowsFromOneHitToTheNext) {
  // 0.1 s fresh from each of the first three Hits, then 0.3 s to the last one: ages up to 0.1 s for 0.4 s,
  // and to 0.3 s for 0.2 s more. Half of 0.6 s is reached at 0.3 / 4; 0.57 s 0.03 s before the end.
  const FixAge age = scores("HHHH..H").fix_age;
  EXPECT_NEAR(*age.median_s, 0.075, 1e-9);
  EXPECT_NEAR(*age.p95_s, 0.27, 1e-9);
  EXPECT_NEAR(*age.max_s, 0.3, 1e-9);
}

TEST(FixAge, IsAtMostTheLargestIntervalWhenEveryFrameIsAHit) {
  EXPECT_NEAR(*scores("HHHHHH").fix_age.max_s, 0.1, 1e-9);
  EXPECT_NEAR(*scores("HH3HHH1HH").fix_age.max_s, 0.4, 1e-9);
}

TEST(FixAge, IsInfiniteBeforeTheFirstHit) {
  const FixAge late = scores("MHHHHHHHHHH").fix_age;  // one tenth of the time without any
  EXPECT_NEAR(*late.median_s, 0.5 / 9 * 1.0, 1e-9);   // 0.5 s of the nine stretches that age side by side
  EXPECT_EQ(late.p95_s, kNever);
  EXPECT_EQ(late.max_s, kNever);
  const FixAge mute = scores("MMMMMM").fix_age;
  EXPECT_EQ(mute.median_s, kNever);
  EXPECT_EQ(mute.p95_s, kNever);
  EXPECT_EQ(mute.max_s, kNever);
}

TEST(FixAge, IsTheLeastAgeNotExceededForItsShareOfTheTime) {
  // Just half of the time, or just 95 % of it, with an age of at most 0.1 s: the rest, infinite, is not asked.
  for (std::size_t n = 1; n <= 100; ++n) {
    const Scores half = scores(std::string(n, 'M') + std::string(n + 1, 'H'));
    EXPECT_NEAR(*half.fix_age.median_s, 0.1, 1e-9) << n;
    const Scores most = scores(std::string(n, 'M') + std::string(19 * n + 1, 'H'));
    EXPECT_NEAR(*most.fix_age.p95_s, 0.1, 1e-9) << n;
  }
}

TEST(FixAge, IsNoYoungerByABoxThatWasGiven) {
  EXPECT_EQ(scores("gMMMM").fix_age.max_s, kNever);
  EXPECT_NEAR(*scores("HMMgMM").fix_age.max_s, 0.5, 1e-9);
}

TEST(FixAge, GrowsOnWhileTheTargetIsAwayButIsNotCountedThere) {
  // Visible: 0.2 s up to the second Hit and the Hit before, then 0.1 s from 0.5 s to 0.6 s of age.
  const FixAge age = scores("HHHrrrrMM").fix_age;
  EXPECT_NEAR(*age.median_s, 0.075, 1e-9);
  EXPECT_NEAR(*age.max_s, 0.6, 1e-9);
}

TEST(FixAge, IsNotAvailableWithoutVisibleTime) {
  const FixAge age = scores("rrrr").fix_age;
  EXPECT_EQ(age.median_s, std::nullopt);
  EXPECT_EQ(age.p95_s, std::nullopt);
  EXPECT_EQ(age.max_s, std::nullopt);
}

// --- Silent share.

TEST(SilentShare, IsOneForABoxThatIsStuckAndZeroForOneThatSaysNothing) {
  EXPECT_EQ(scores("HHHHSSSSSSSS").silent_share, 1);
  EXPECT_EQ(scores("HHHHMMMMMMMM").silent_share, 0);
}

TEST(SilentShare, IsTheShareOfTimeThatAWrongAnswerIsInForce) {
  // From the first lost frame, 0.1 s each: S S M M M S, and the loss ends at the Hit.
  EXPECT_NEAR(*scores("HHHHSSMMMSHHH").silent_share, 3.0 / 6, 1e-12);
}

TEST(SilentShare, CountsAWrongCodeAndAPlaceHeldOffCentreAsAnswers) {
  EXPECT_NEAR(*scores("HHHHWWMMHHH").silent_share, 2.0 / 4, 1e-12);
  EXPECT_EQ(scores("HHHHssssssssssssHHH").silent_share, 1);  // drift
}

TEST(SilentShare, LetsAnAnswerStandOverDroppedFrames) {
  // S for 0.3 s, then three times nothing.
  EXPECT_NEAR(*scores("HHHHS..MMMHHH").silent_share, 3.0 / 6, 1e-12);
}

TEST(SilentShare, LeavesOutTheTimeBeforeTheFirstLostFrameAndUnderIsolatedHits) {
  // The gap before the loss is lost time, but it is not known what would have been said in it.
  EXPECT_NEAR(*scores("HHHH9SMMMHHH").silent_share, 1.0 / 4, 1e-12);
  EXPECT_NEAR(*scores("HHHHSMMHMMHHH").silent_share, 1.0 / 5, 1e-12);
}

TEST(SilentShare, IsNotAvailableWithoutALoss) {
  EXPECT_EQ(scores("HHHHHH").silent_share, std::nullopt);
  EXPECT_EQ(scores("SSSSSS").silent_share, std::nullopt);  // never had it, so never lost it
}

// --- Rates and bins.

TEST(F1, IsTheHarmonicMeanOfRecognitionAndPrecision) {
  const Scores s = scores("HHHMMMMS");  // 3 of 8 recognised, 3 of 4 answers right
  EXPECT_NEAR(*s.f1, 2 * 3.0 / (8 + 4), 1e-12);
  EXPECT_EQ(scores("MMMM").f1, 0);
  EXPECT_EQ(scores("FF").f1, 0);
  EXPECT_EQ(scores("rrrr").f1, std::nullopt);
}

TEST(WrongIdentityRate, IsOverAnswersAtTheTargetsPlace) {
  EXPECT_EQ(scores("HHHWMMSS").wrong_identity_rate, 0.25);
  EXPECT_EQ(scores("MMSS").wrong_identity_rate, std::nullopt);
}

TEST(FalseAlarms, CountAllSightingsOnFramesWithoutATarget) {
  Case c = timeline("HHHFrrr");
  EXPECT_EQ(sheet_of(c).pooled.false_alarms_per_1000, 250);
  c.trajectory.frames[4].sightings = {sighting_of(Box{10, 10, 40, 40}), sighting_of(Box{90, 90, 40, 40})};
  const ScoreSheet sheet = sheet_of(c);
  EXPECT_EQ(sheet.pooled.false_alarms_per_1000, 750);
  // Two claimed nobody, in 0.7 s of recording.
  EXPECT_NEAR(*sheet.pooled.spurious_per_minute, 2 * 60 / 0.7, 1e-9);
  EXPECT_EQ(sheet.targets[0].false_alarms_per_1000, std::nullopt);
  EXPECT_EQ(sheet.targets[0].spurious_per_minute, std::nullopt);
  EXPECT_EQ(scores("HHH").false_alarms_per_1000, std::nullopt);
}

TEST(GapBins, GoByTheSlotsSinceTheLastFrameThatWasNotDropped) {
  const auto bins = scores("HHH.M...H3S9H").by_gap;  // slots: 1 1 1 2 4 4 10
  const std::array<HitCount, kGapBinCount> expected{{{3, 3}, {1, 0}, {2, 1}, {0, 0}, {1, 1}}};
  for (std::size_t i = 0; i < kGapBinCount; ++i) {
    EXPECT_EQ(bins[i].could_hit, expected[i].could_hit) << gap_bin_name(i);
    EXPECT_EQ(bins[i].hits, expected[i].hits) << gap_bin_name(i);
  }
}

TEST(BlurBins, TakeTheirUpperEndIn) {
  Case c = timeline("HHHHMH");
  const std::array<std::optional<BlurVector>, 6> blurs{
      {{{0, 0}}, {{3, 4}}, {{-5, 0.1}}, {{0, 80}}, {{0, 81}}, {}}};
  for (std::size_t k = 0; k < blurs.size(); ++k) c.recording.truth[k].blur = blurs[k];
  const auto bins = sheet_of(c).pooled.by_blur;
  const std::array<HitCount, kBlurBinCount> expected{
      {{2, 2}, {1, 1}, {0, 0}, {0, 0}, {1, 1}, {1, 0}, {1, 1}}};
  for (std::size_t i = 0; i < kBlurBinCount; ++i) {
    EXPECT_EQ(bins[i].could_hit, expected[i].could_hit) << blur_bin_name(i);
    EXPECT_EQ(bins[i].hits, expected[i].hits) << blur_bin_name(i);
  }
}

// --- Adding up.

Tally sum_over_targets(const Case& c, const Evaluation& evaluation) {
  Tally sum = tally_of_frames(c.recording, evaluation);
  for (std::size_t t = 0; t < c.recording.targets.size(); ++t)
    sum += tally(c.recording, c.trajectory, evaluation, t).tally;
  return sum;
}

void expect_same(const Scores& a, const Scores& b) {
  EXPECT_EQ(a.verdicts, b.verdicts);
  EXPECT_EQ(a.f1, b.f1);
  EXPECT_EQ(a.false_alarms_per_1000, b.false_alarms_per_1000);
  EXPECT_EQ(a.spurious_per_minute, b.spurious_per_minute);
  EXPECT_EQ(a.availability, b.availability);
  EXPECT_EQ(a.fix_age.median_s, b.fix_age.median_s);
  EXPECT_EQ(a.fix_age.p95_s, b.fix_age.p95_s);
  EXPECT_EQ(a.fix_age.max_s, b.fix_age.max_s);
  EXPECT_EQ(a.silent_share, b.silent_share);
  EXPECT_EQ(a.recovery.median_s, b.recovery.median_s);
  EXPECT_EQ(a.localization.rms_px, b.localization.rms_px);
}

TEST(Tallies, OfTheTargetsAddUpToThePooledScores) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    const Case c = random_case(seed);
    const Evaluation evaluation = evaluate(c.recording, c.trajectory);
    expect_same(scores_of(sum_over_targets(c, evaluation)),
                score(c.recording, c.trajectory, evaluation).pooled);
  }
}

TEST(Tallies, OfTwoRecordingsAddUp) {
  const auto tally_of = [](const std::string& letters) {
    const Case c = timeline(letters);
    return sum_over_targets(c, evaluate(c.recording, c.trajectory));
  };
  Tally both = tally_of("HHHHSSSS");  // 0.3 s in force over the loss, all with a wrong answer
  both += tally_of("HHHHMMMMMMrr");   // 0.5 s, none
  const Scores s = scores_of(both);
  EXPECT_EQ(s.frames, 20u);
  EXPECT_NEAR(*s.recognition, 8.0 / 18, 1e-12);
  EXPECT_NEAR(*s.silent_share, 3.0 / 8, 1e-12);
  EXPECT_EQ(s.losses, 2u);
  EXPECT_NEAR(*s.fix_age.max_s, 0.6, 1e-9);
  EXPECT_EQ(s.false_alarms_per_1000, 0);
}

}  // namespace
}  // namespace relock
