// Properties that every evaluation must have, on random timelines.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/random.h"
#include "eval/judgement/visible_time.h"
#include "eval/scores/scores.h"
#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

constexpr std::uint64_t kSeeds = 400;

struct Judged {
  Evaluation evaluation;
  ScoreSheet sheet;
};
Judged judged(const Case& c) {
  Judged result{evaluate(c.recording, c.trajectory), {}};
  result.sheet = score(c.recording, c.trajectory, result.evaluation);
  return result;
}

bool same_verdicts(const Evaluation& a, const Evaluation& b) {
  for (std::size_t t = 0; t < a.targets.size(); ++t) {
    const auto& x = a.targets[t].judgements;
    const auto& y = b.targets[t].judgements;
    if (!std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const Judgement& p, const Judgement& q) {
          return p.verdict == q.verdict && p.hold == q.hold;
        }))
      return false;
    if (a.targets[t].states != b.targets[t].states) return false;
  }
  return a.spurious == b.spurious;
}

TEST(Verdicts, OfEveryTargetAddUpToTheRecordedFrames) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    for (const Scores& s : judged(c).sheet.targets)
      EXPECT_EQ(std::accumulate(s.verdicts.begin(), s.verdicts.end(), std::size_t{0}), c.recording.frames());
  }
}

TEST(Sightings, CountExactlyOnceEach) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    const Evaluation e = evaluate(c.recording, c.trajectory);
    for (std::size_t k = 0; k < c.recording.frames(); ++k) {
      int counted = e.spurious[k] + e.ignored[k];
      for (const TargetTimeline& target : e.targets) counted += target.judgements[k].sighting >= 0 ? 1 : 0;
      EXPECT_EQ(counted, static_cast<int>(c.trajectory.frames[k].sightings.size()))
          << "seed " << seed << " frame " << k;
    }
  }
}

TEST(VisibleTime, IsLockedLostAndSearchingTimeTogether) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    const Judged j = judged(c);
    for (std::size_t t = 0; t < c.recording.targets.size(); ++t) {
      const auto visible = visible_time(c.recording, t, j.evaluation.targets[t].judgements);
      Duration all{0};
      for (const auto& interval : visible) all += interval.to - interval.from;
      const Scores& s = j.sheet.targets[t];
      EXPECT_DOUBLE_EQ(s.visible_s, seconds(all));
      EXPECT_NEAR(s.locked_s + s.lost_s + s.searching_s, s.visible_s, 1e-9);
      EXPECT_GE(s.searching_s, 0);
    }
  }
}

TEST(Scores, DoNotChangeWhenTimeIsShifted) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Case c = random_case(seed);
    const Judged before = judged(c);
    for (Time& time : c.recording.captured) time += std::chrono::hours(1000);
    const Judged after = judged(c);
    EXPECT_TRUE(same_verdicts(before.evaluation, after.evaluation));
    EXPECT_EQ(before.sheet.pooled.availability, after.sheet.pooled.availability);
  }
}

Vec2 scaled(Vec2 v) { return 4.0 * v; }
Outline scaled(const Outline& outline) {
  if (const auto* b = std::get_if<Box>(&outline)) return Box{4 * b->x, 4 * b->y, 4 * b->width, 4 * b->height};
  if (const auto* q = std::get_if<Quad>(&outline)) {
    Quad bigger;
    std::transform(q->corner.begin(), q->corner.end(), bigger.corner.begin(),
                   [](Vec2 v) { return scaled(v); });
    return bigger;
  }
  Ellipse e = std::get<Ellipse>(outline);
  return Ellipse{scaled(e.centre), 4 * e.semi_major, 4 * e.semi_minor, e.angle_rad};
}

TEST(Scores, DoNotChangeWhenPictureAndAnswersAreScaledTogether) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Case c = random_case(seed);
    const Judged before = judged(c);
    c.recording.picture = {4 * c.recording.picture.width, 4 * c.recording.picture.height};
    for (TargetTruth& truth : c.recording.truth) {
      if (truth.outline) truth.outline = scaled(*truth.outline);
      if (truth.centre_projected) truth.centre_projected = scaled(*truth.centre_projected);
    }
    for (FrameReport& report : c.trajectory.frames)
      for (Sighting& s : report.sightings) s.centre = scaled(s.centre), s.outline = scaled(s.outline);
    EXPECT_TRUE(same_verdicts(before.evaluation, judged(c).evaluation)) << "seed " << seed;
  }
}

TEST(Scores, DoNotChangeWhenTargetsAreRenamed) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Case c = random_case(seed);
    const Judged before = judged(c);
    const auto renamed = [](const TargetId& id) { return "zz" + std::string(id.rbegin(), id.rend()); };
    for (Target& target : c.recording.targets) target.id = renamed(target.id);
    for (FrameReport& report : c.trajectory.frames)
      for (Sighting& s : report.sightings)
        if (s.track) s.track = renamed(*s.track);
    EXPECT_TRUE(same_verdicts(before.evaluation, judged(c).evaluation)) << "seed " << seed;
  }
}

/// The case with what the method said put in the place of what it says now.
template <class Say>
Case resaid(Case c, Say say) {
  for (std::size_t k = 0; k < c.recording.frames(); ++k) {
    FrameReport& report = c.trajectory.frames[k];
    if (report.delivery == Delivery::skipped) report.delivery = Delivery::delivered;
    report.sightings.clear();
    if (report.delivery == Delivery::delivered) say(c.recording, k, report);
  }
  return c;
}

Case perfect(const Case& c) {
  return resaid(c, [](const Recording& recording, std::size_t k, FrameReport& report) {
    for (std::size_t t = 0; t < recording.targets.size(); ++t) {
      if (recording.truth_of(k, t).label != Label::visible) continue;
      Sighting s = sighting_of(*recording.truth_of(k, t).outline);
      s.code = recording.targets[t].code;
      s.track = recording.targets[t].id;
      report.sightings.push_back(s);
    }
  });
}

TEST(Oracle, ScoresOne) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Scores s = judged(perfect(random_case(seed))).sheet.pooled;
    for (const auto& value :
         {s.recognition, s.precision, s.availability_of_ceiling, s.locked_share_of_ceiling})
      if (value) {
        EXPECT_DOUBLE_EQ(*value, 1) << "seed " << seed;
      }
    EXPECT_EQ(s.losses, 0u);
  }
}

TEST(Mute, ScoresZero) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Case c = resaid(random_case(seed),
                    [](const Recording&, std::size_t, FrameReport& report) { report.given.clear(); });
    const Scores s = judged(c).sheet.pooled;
    for (const auto& value : {s.recognition, s.precision, s.availability, s.locked_share})
      if (value) {
        EXPECT_EQ(*value, 0);
      }
  }
}

TEST(Silence, GainsNothing) {
  // Answers taken away at random: no Hit, no fix and no lock more than with them.
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case whole = perfect(random_case(seed));
    Case silent = whole;
    Random random(seed);
    for (FrameReport& report : silent.trajectory.frames)
      if (random.chance(0.3)) report.sightings.clear();
    const Scores a = judged(whole).sheet.pooled, b = judged(silent).sheet.pooled;
    EXPECT_LE(b.recognition.value_or(0), a.recognition.value_or(0));
    EXPECT_LE(b.availability.value_or(0), a.availability.value_or(0));
    EXPECT_LE(b.locked_s, a.locked_s + 1e-9);
  }
}

TEST(Shouting, GainsNoPrecisionAndNoHitThatWasNotEarned) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case quiet = perfect(random_case(seed));
    Case loud = quiet;
    Random random(seed);
    for (FrameReport& report : loud.trajectory.frames) {
      if (report.delivery != Delivery::delivered) continue;
      for (int i = 0; i < 5; ++i) {
        Sighting s = sighting_of(Box{5000 + 500 * random.uniform(), 5000, 20, 20});
        report.sightings.push_back(s);
      }
    }
    const Scores a = judged(quiet).sheet.pooled, b = judged(loud).sheet.pooled;
    EXPECT_EQ(a.recognition, b.recognition);
    EXPECT_EQ(a.availability, b.availability);
    EXPECT_LE(b.precision.value_or(0), a.precision.value_or(0));
  }
}

TEST(Availability, IsLoweredByALongGapEvenWhenBothEndsAreHits) {
  Case c;
  c.recording.period = std::chrono::milliseconds(33);
  c.recording.targets = {{"t"}};
  for (int k = 0; k < 30; ++k) {
    const int slot = k < 15 ? k : k + 10;
    c.recording.captured.push_back(Time{slot * c.recording.period});
    TargetTruth truth;
    truth.label = Label::visible;
    truth.outline = Box{0, 0, 40, 40};
    c.recording.truth.push_back(truth);
    c.trajectory.frames.push_back({Delivery::delivered, {}, {sighting_of(Box{0, 0, 40, 40})}});
  }
  c.trajectory.judged_from = {0};
  c.trajectory.failed_from = {std::nullopt};
  const Scores s = judged(c).sheet.pooled;
  EXPECT_EQ(s.recognition, 1);
  EXPECT_LT(*s.availability, 0.85);
  EXPECT_DOUBLE_EQ(*s.availability_of_ceiling, 1);
  EXPECT_EQ(s.locked_share, 1);
}

}  // namespace
}  // namespace relock
