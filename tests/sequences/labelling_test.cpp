#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "sequences/labelling/fill.h"
#include "sequences/labelling/next_click.h"
#include "sequences/labelling/outline_numbers.h"
#include "sequences/labelling/smooth_curve.h"

namespace relock {
namespace {

constexpr Size kPicture{640, 480};

/// Frames at 30 Hz, of which every `nth` is missing.
std::vector<Time> times(std::size_t frames, std::size_t nth = 0, Duration offset = Duration{0}) {
  std::vector<Time> all;
  for (std::int64_t slot = 0; all.size() < frames; ++slot)
    if (nth == 0 || slot % static_cast<std::int64_t>(nth) != 3)
      all.push_back(Time{offset + slot * period_of(30)});
  return all;
}

KeyFrame placed(std::size_t frame, const Outline& outline, double sigma_px = 1) {
  return {frame, KeyState::placed, outline, sigma_px, {LabelSource::Kind::hand}};
}

KeyFrame said(std::size_t frame, KeyState state) { return {frame, state, {}, 1, {LabelSource::Kind::hand}}; }

Vec2 on_a_line(Time t) { return {100 + 80 * seconds(t), 300 - 55 * seconds(t)}; }

Box box_about(Vec2 centre, double width = 40, double height = 30) {
  return {centre.x - width / 2, centre.y - height / 2, width, height};
}

Quad turned(Vec2 centre, double size, double angle) {
  Quad quad;
  for (std::size_t i = 0; i < 4; ++i) {
    const double at = angle + (static_cast<double>(i) + 0.5) * M_PI / 2;
    quad.corner[i] = centre + size * Vec2{std::cos(at), std::sin(at)};
  }
  return quad;
}

/// A flight that turns, sways and shakes: the quicker, the less, as bodies with mass do.
Vec2 lively(Time t) {
  Vec2 at{320, 240};
  Random phases(7);
  for (int k = 1; k <= 16; ++k) {
    const double turn = 0.7 * k * seconds(t), far = 130.0 / (k * k);
    at = at + far * Vec2{std::sin(turn + static_cast<double>(phases.below(628)) / 100),
                         std::sin(turn + static_cast<double>(phases.below(628)) / 100)};
  }
  return at;
}

/// Keys on every nth frame, placed by a hand that trembles.
KeyedTarget labelled(const std::vector<Time>& captured, Vec2 (*where)(Time), std::size_t nth,
                     double tremble = 0, std::uint64_t seed = 1) {
  Random random(seed);
  const auto off = [&] {  // of about normal distribution
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random.below(10001)) / 10000 - 0.5;
    return tremble * sum;
  };
  KeyedTarget target{"t", {}};
  for (std::size_t frame = 0; frame < captured.size(); frame += nth) {
    const Vec2 at = where(captured[frame]);
    put_key(target, placed(frame, box_about({at.x + off(), at.y + off()}), tremble > 0 ? tremble : 1));
  }
  return target;
}

FilledTarget filled(const KeyedTarget& target, const std::vector<Time>& captured,
                    const FillOptions& options = {}) {
  return fill(target, captured, kPicture, options);
}

TEST(Fill, FollowsAStraightLineOnTrueTimeExactly) {
  const auto captured = times(60, 5);  // frames are missing: a line on time is none on frame numbers
  const FilledTarget result = filled(labelled(captured, on_a_line, 14), captured);
  for (std::size_t frame = 0; frame <= 56; ++frame) {
    ASSERT_TRUE(result.truth[frame].outline) << frame;
    EXPECT_LT(norm(centre_of(*result.truth[frame].outline) - on_a_line(captured[frame])), 1e-6) << frame;
    EXPECT_EQ(result.truth[frame].label, Label::visible);
  }
}

TEST(Fill, FollowsQuadsAndEllipsesThatMoveSteadilyExactly) {
  const auto captured = times(31);
  KeyedTarget quads{"q", {}}, ellipses{"e", {}};
  const auto ellipse = [&](std::size_t frame) {
    const double turned_by =
        2.9 + 0.02 * static_cast<double>(frame);  // past half a turn, where the angle starts anew
    return Ellipse{on_a_line(captured[frame]), 30, 12, std::fmod(turned_by, M_PI)};
  };
  for (const std::size_t frame : {0, 10, 20, 30}) {
    put_key(quads, placed(frame, turned(on_a_line(captured[frame]), 25, 0.3)));
    put_key(ellipses, placed(frame, ellipse(frame)));
  }
  const FilledTarget quad = filled(quads, captured), round = filled(ellipses, captured);
  for (std::size_t frame = 0; frame < captured.size(); ++frame) {
    const Quad expected = turned(on_a_line(captured[frame]), 25, 0.3);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT(norm(std::get<Quad>(*quad.truth[frame].outline).corner[i] - expected.corner[i]), 1e-6);
    const auto& e = std::get<Ellipse>(*round.truth[frame].outline);
    EXPECT_LT(between_axes(e.angle_rad, ellipse(frame).angle_rad), 1e-6) << frame;
    EXPECT_NEAR(e.semi_major, 30, 1e-6);
  }
}

TEST(Fill, DoesNotChangeWithTheClocksOffset) {
  const auto now = times(200, 7), later = times(200, 7, std::chrono::hours(24 * 365 * 40));
  const FilledTarget a = filled(labelled(now, lively, 13), now);
  KeyedTarget same = labelled(now, lively, 13);
  const FilledTarget b = filled(same, later);
  for (std::size_t frame = 0; frame < now.size(); ++frame) {
    EXPECT_EQ(a.truth[frame].outline, b.truth[frame].outline) << frame;
    EXPECT_EQ(a.truth[frame].sigma_px, b.truth[frame].sigma_px) << frame;
  }
}

TEST(Fill, KeepsWhatWasSaidOnAKeyFrameAsItWasSaid) {
  const auto captured = times(100);
  const KeyedTarget target = labelled(captured, lively, 9, 2.0);
  const FilledTarget result = filled(target, captured);
  for (const KeyFrame& key : target.keys) {
    EXPECT_EQ(result.truth[key.frame].outline, key.outline);
    EXPECT_EQ(result.truth[key.frame].sigma_px, 2.0);
    EXPECT_EQ(to_string(result.truth[key.frame].source), "hand");
    EXPECT_EQ(result.rests_on[key.frame], RestsOn::key);
  }
  EXPECT_EQ(to_string(result.truth[1].source), "spline");
}

/// Of left-out things, how many standard deviations off along x and y.
double share_within(const std::vector<double>& z, double limit) {
  std::size_t within = 0;
  for (const double each : z) within += std::abs(each) <= limit ? 1 : 0;
  return static_cast<double>(within) / static_cast<double>(z.size());
}

TEST(Fill, StatesASigmaThatCoversTheTrueWayAsOftenAsItSays) {
  for (const double tremble : {0.5, 2.0})
    for (const std::size_t nth : {6, 12, 24}) {
      std::vector<double> z;
      for (const std::uint64_t seed : {1, 2, 3}) {
        const auto captured = times(600, 11);
        const FilledTarget result = filled(labelled(captured, lively, nth, tremble, seed), captured);
        for (std::size_t frame = 0; frame < captured.size(); ++frame) {
          if (result.rests_on[frame] != RestsOn::curve) continue;
          const Vec2 off = centre_of(*result.truth[frame].outline) - lively(captured[frame]);
          z.push_back(off.x / result.truth[frame].sigma_px);
          z.push_back(off.y / result.truth[frame].sigma_px);
        }
      }
      EXPECT_GT(share_within(z, 1), 0.6) << "tremble " << tremble << ", every " << nth;
      EXPECT_GT(share_within(z, 2), 0.9) << "tremble " << tremble << ", every " << nth;
      EXPECT_LT(share_within(z, 0.3), 0.6) << "it is not just large";
    }
}

TEST(CrossValidation, FindsLeftOutKeyFramesWithinTheStatedSigmaAsOftenAsItSays) {
  const auto captured = times(400);
  std::vector<double> z;
  for (const KeyResidual& left :
       cross_validate(labelled(captured, lively, 10, 1.0), captured, kPicture, {})) {
    z.push_back(left.error_px.x / left.sigma_px);
    z.push_back(left.error_px.y / left.sigma_px);
  }
  EXPECT_EQ(z.size(), 2 * 38u) << "all but the ends, which nothing reaches";
  EXPECT_GT(share_within(z, 1), 0.6);
  EXPECT_GT(share_within(z, 2), 0.9);
}

TEST(LeaveEachOut, TellsWhatFittingWithoutTheReadingTells) {
  Readings readings{{0, 0.3, 0.7, 1.1, 1.6, 1.8}, {1, 2, 1.5, 3, 2, 2.2}, {0.1, 0.1, 0.1, 0.1, 0.1, 0.1}};
  const CurveModel model{2, 40, 0};
  const auto left = leave_each_out(readings, model);
  for (const std::size_t out : {1, 2, 3, 4}) {
    Readings others = readings;
    const auto at = static_cast<std::ptrdiff_t>(out);
    others.at_s.erase(others.at_s.begin() + at);
    others.value.erase(others.value.begin() + at);
    others.sigma.erase(others.sigma.begin() + at);
    const SmoothCurve curve(others, model);
    ASSERT_TRUE(left[out]);
    // Both are the same curve but for where their pieces end.
    EXPECT_NEAR(left[out]->error, readings.value[out] - curve.value(readings.at_s[out]),
                0.05 * left[out]->sigma);
    EXPECT_NEAR(left[out]->sigma, std::hypot(0.1, curve.sigma(readings.at_s[out])), 0.05 * left[out]->sigma);
  }
}

TEST(Fill, IsNotThrownOffBySlipsOfTheHand) {
  const auto captured = times(300);
  KeyedTarget target = labelled(captured, on_a_line, 6);
  target.keys[20].outline = box_about(on_a_line(captured[target.keys[20].frame]) + Vec2{60, -40});
  const FilledTarget result = filled(target, captured);
  const std::size_t far = target.keys[20].frame + 40;
  EXPECT_LT(norm(centre_of(*result.truth[far].outline) - on_a_line(captured[far])), 2)
      << "farther on it is right";
}

TEST(Fill, NeverCrossesAnAbsence) {
  const auto captured = times(60);
  KeyedTarget target = labelled(captured, on_a_line, 10);
  take_key(target, 30);
  put_key(target, said(28, KeyState::absent));
  const FilledTarget result = filled(target, captured);
  for (std::size_t frame = 0; frame < 60; ++frame) {
    const Label label = result.truth[frame].label;
    if (frame <= 20 || (frame >= 40 && frame <= 50)) {
      EXPECT_EQ(label, Label::visible) << frame;
    } else if (frame >= 28 && frame < 40) {
      EXPECT_EQ(label, Label::absent) << frame;
      EXPECT_EQ(to_string(result.truth[frame].source), "hand");
    } else {
      EXPECT_EQ(label, Label::unlabelled) << "when it went nobody said: " << frame;
      EXPECT_FALSE(result.truth[frame].outline);
    }
  }
}

TEST(Fill, NeverCrossesWhatNobodyCanTellNorMoreThanTheStatedGap) {
  const auto captured = times(200);
  KeyedTarget target{"t", {}};
  for (const std::size_t frame : {0, 20, 100, 120, 150, 170})
    put_key(target, placed(frame, box_about({200, 200})));
  put_key(target, said(160, KeyState::unlabelled));
  const FilledTarget result = filled(target, captured, {.max_gap_s = 2.0});
  for (std::size_t frame = 0; frame < 200; ++frame) {
    const bool known = frame <= 20 || (frame >= 100 && frame <= 150) || frame == 170;
    EXPECT_EQ(result.truth[frame].label == Label::visible, known) << frame;
  }
  EXPECT_EQ(result.rests_on[165], RestsOn::held);
  EXPECT_EQ(result.rests_on[60], RestsOn::unknown);
}

TEST(Fill, KnowsThePlaceOfAnOccludedTargetButDoesNotCallItVisible) {
  const auto captured = times(41);
  KeyedTarget target = labelled(captured, on_a_line, 20);
  put_key(target, said(15, KeyState::occluded));
  put_key(target, placed(25, box_about(on_a_line(captured[25]))));
  take_key(target, 20);
  const FilledTarget result = filled(target, captured);
  for (std::size_t frame = 15; frame < 25; ++frame) {
    EXPECT_EQ(result.truth[frame].label, Label::unlabelled) << frame;
    EXPECT_EQ(result.truth[frame].outline.has_value(), frame != 15) << frame;
  }
  EXPECT_EQ(result.truth[14].label, Label::visible);
  EXPECT_EQ(result.truth[25].label, Label::visible);
}

TEST(Fill, NamesTheDetectorsWhoseAnswersACurveGoesThrough) {
  const auto captured = times(61);
  KeyedTarget target = labelled(captured, on_a_line, 20);
  target.keys[1].source = parse_label_source("detector ring");
  const FilledTarget result = filled(target, captured);
  EXPECT_EQ(to_string(result.truth[20].source), "detector ring");
  EXPECT_EQ(to_string(result.truth[10].source), "spline detector ring");
  EXPECT_EQ(to_string(result.truth[40].source), "hand");
}

TEST(Fill, OfNothingIsNothing) {
  const auto captured = times(5);
  for (const KeyedTarget& target : {KeyedTarget{"t", {}}, KeyedTarget{"t", {placed(2, box_about({9, 9}))}}}) {
    const FilledTarget result = filled(target, captured);
    for (std::size_t frame = 0; frame < 5; ++frame)
      EXPECT_EQ(result.truth[frame].label == Label::visible, !target.keys.empty() && frame == 2);
  }
}

TEST(OutlineNumbers, MakeTheSameOutlineAgain) {
  for (const Outline& outline : {Outline(box_about({50, 60})), Outline(turned({50, 60}, 20, 1.1)),
                                 Outline(Ellipse{{50, 60}, 20, 9, 2.5})}) {
    const Box a = bounds(outline), b = bounds(outline_of(numbers_of(outline), outline));
    EXPECT_NEAR(a.x, b.x, 1e-9);
    EXPECT_NEAR(a.bottom(), b.bottom(), 1e-9);
  }
}

// --- Where one more click helps most.

TEST(NextClick, LeadsThroughAWholeRecordingWithAClickOnFewerThanEveryFifthFrame) {
  const auto captured = times(300, 11);
  KeyedTarget target{"t", {}};
  const FillOptions options;
  std::size_t clicks = 0;
  for (; clicks < 300; ++clicks) {
    const FilledTarget result = filled(target, captured, options);
    const ClicksToGo to_go = clicks_to_go(target, result, captured, {}, options);
    if (!to_go.next) break;
    ASSERT_NE(result.rests_on[to_go.next->frame], RestsOn::key) << "clicked already";
    put_key(target, placed(to_go.next->frame, box_about(lively(captured[to_go.next->frame]))));
  }
  EXPECT_LT(clicks, 60u);
  const FilledTarget result = filled(target, captured, options);
  for (std::size_t frame = 0; frame < captured.size(); ++frame) {
    ASSERT_EQ(result.truth[frame].label, Label::visible) << frame;
    EXPECT_LT(norm(centre_of(*result.truth[frame].outline) - lively(captured[frame])), 8) << frame;
  }
}

TEST(NextClick, BeginsWhereThereIsNothingAndEndsWhenAllIsSaid) {
  const auto captured = times(30);
  KeyedTarget target{"t", {}};
  const auto next = [&] { return clicks_to_go(target, filled(target, captured), captured, {}, {}); };
  EXPECT_EQ(next().next->worth, Worth::nothing_yet);
  EXPECT_EQ(next().next->frame, 0u);
  put_key(target, said(0, KeyState::absent));
  EXPECT_FALSE(next().next);
  EXPECT_EQ(next().count, 0u);
}

TEST(NextClick, GoesWhereThePictureDisagrees) {
  const auto captured = times(40);
  const KeyedTarget target = labelled(captured, on_a_line, 13);
  const FilledTarget result = filled(target, captured);
  ASSERT_FALSE(clicks_to_go(target, result, captured, {}, {}).next) << "a line is certain";
  std::vector<double> likeness(40, 0.95);
  likeness[17] = 0.1;
  likeness[18] = std::numeric_limits<double>::quiet_NaN();
  const ClicksToGo to_go = clicks_to_go(target, result, captured, likeness, {});
  ASSERT_TRUE(to_go.next);
  EXPECT_EQ(to_go.next->frame, 17u);
  EXPECT_EQ(to_go.next->worth, Worth::disagrees);
}

TEST(NextClick, CountsFewerTheMoreIsSaid) {
  const auto captured = times(301);
  const auto count = [&](std::size_t nth) {
    const KeyedTarget target = labelled(captured, lively, nth, 0.5);
    return clicks_to_go(target, filled(target, captured), captured, {}, {}).count;
  };
  EXPECT_GT(count(50), count(12));
  EXPECT_EQ(count(3), 0u);
}

}  // namespace
}  // namespace relock
