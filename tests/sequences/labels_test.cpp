#include "sequences/labels.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/random.h"
#include "sequences/open.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

Recording blank(std::size_t frames = 5) {
  Recording recording;
  recording.name = "flight";
  recording.picture = {100, 80};
  recording.period = period_of(30);
  for (std::size_t i = 0; i < frames; ++i)
    recording.captured.push_back(Time{static_cast<std::int64_t>(i) * recording.period});
  return recording;
}

Recording read(const std::string& text, const Description& description = {}) {
  Recording recording = blank();
  std::istringstream in(text);
  read_labels(in, "labels.csv", description, {}, recording);
  return recording;
}

std::string fault(const std::string& text, const Description& description = {}) {
  return fault_of([&] { read(text, description); });
}

TEST(Labels, LeaveFramesWithoutARowUnlabelled) {
  const Recording recording = read("frame,x,y,width,height\n1,10,10,20,20\n");
  ASSERT_EQ(recording.targets.size(), 1u);
  EXPECT_EQ(recording.truth_of(0, 0).label, Label::unlabelled);
  EXPECT_EQ(recording.truth_of(1, 0).label, Label::visible);
}

TEST(Labels, FollowFromThePartOfTheOutlineInThePicture) {
  // The picture covers x from -0.5 to 99.5.
  const Recording recording = read("frame,x,y,width,height\n0,89.5,10,20,20\n1,91.5,10,20,20\n");
  EXPECT_EQ(recording.truth_of(0, 0).label, Label::visible) << "half of it";
  EXPECT_EQ(recording.truth_of(1, 0).label, Label::unlabelled) << "less than half";
  EXPECT_TRUE(recording.truth_of(1, 0).outline) << "its place is known all the same";
}

TEST(Labels, KnowTheProjectedCentreOfAQuadByItsDiagonals) {
  const Recording recording = read("frame,x1,y1,x2,y2,x3,y3,x4,y4\n0,10,10,30,14,30,26,10,30\n");
  const TargetTruth& truth = recording.truth_of(0, 0);
  ASSERT_TRUE(truth.centre_projected);
  EXPECT_GT(truth.centre(CentreKind::projected).x, truth.centre(CentreKind::outline).x);
}

TEST(Labels, OfAnotherRecordingAreTold) {
  EXPECT_EQ(fault("frame,x,y,width,height\n0,1,1,9,9\n4071,1,1,9,9\n"),
            "labels.csv:3: frame 4071 does not exist in flight (it has 5 frames, from 0); were these labels "
            "made for "
            "another recording?");
  EXPECT_NE(
      fault("frame,x,y,width,height\n0,500,10,20,20\n").find("labels.csv:2: the target at x 500.0 to 520.0"),
      std::string::npos);
}

TEST(Labels, RefuseWhatCannotBeMeant) {
  EXPECT_NE(fault("frame,x,y,width,height\n0,1,1,9,9\n0,1,1,9,9\n")
                .find("labels.csv:3: target target is labelled twice"),
            std::string::npos);
  EXPECT_NE(fault("frame,x,y,width,height\n0,nan,1,9,9\n").find("labels.csv:2: column x"), std::string::npos);
  EXPECT_NE(fault("frame,x,y,width,height\n0,1,1,-9,9\n").find("has no size"), std::string::npos);
  EXPECT_NE(fault("frame,label,x,y,width,height\n0,seen,1,1,9,9\n").find("\"seen\" is none of"),
            std::string::npos);
  EXPECT_NE(fault("frame,visible_fraction,x,y,width,height\n0,1.5,1,1,9,9\n").find("not between 0 and 1"),
            std::string::npos);
  Description described;
  described.targets.push_back({{"door"}, {}});
  described.targets.push_back({{"window"}, {}});
  EXPECT_NE(fault("frame,target,x,y,width,height\n0,dor,1,1,9,9\n", described).find("did you mean \"door\"?"),
            std::string::npos);
}

TEST(Labels, AreTheSameAfterWritingAndReading) {
  Random random(9);
  Recording recording = blank(40);
  recording.targets = {{"a", parse_code("f:1"), 0.15}, {"b"}};
  recording.truth.resize(80);
  for (TargetTruth& truth : recording.truth) {
    // Binary fractions with four decimals at most, so that sums and files are exact.
    const auto coordinate = [&] { return static_cast<double>(random.below(960)) / 16; };
    truth.label = static_cast<Label>(random.below(3));
    if (truth.label != Label::absent)
      truth.outline = Box{coordinate(), coordinate(), 1 + coordinate(), 1 + coordinate()};
    if (random.chance(0.5)) truth.blur = Vec2{coordinate(), -coordinate()};
    if (random.chance(0.5)) truth.tilt_deg = coordinate();
    truth.visible_fraction = truth.label == Label::visible ? 0.75 : 0.25;
    truth.sigma_px = 0.5;
    truth.source = parse_label_source(random.chance(0.5) ? "hand" : "spline detector aruco+ring");
  }
  const Scratch scratch;
  write_truth(scratch.path(), recording);
  const Recording back = read_truth(scratch.path());
  EXPECT_EQ(back.targets, recording.targets);
  EXPECT_EQ(back.captured, recording.captured);
  EXPECT_EQ(back.period, recording.period);
  EXPECT_EQ(back.picture, recording.picture);
  for (std::size_t i = 0; i < recording.truth.size(); ++i) {
    const TargetTruth &a = recording.truth[i], &b = back.truth[i];
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.outline, b.outline);
    if (a.label == Label::unlabelled && !a.outline) continue;
    EXPECT_EQ(a.blur, b.blur);
    EXPECT_EQ(a.tilt_deg, b.tilt_deg);
    EXPECT_EQ(a.visible_fraction, b.visible_fraction);
    EXPECT_EQ(a.source, b.source);
  }
}

TEST(Labels, ThatStateNoSourceAreWrittenAsTheyWereBeforeThereWereSources) {
  const Recording recording = read("frame,x,y,width,height\n1,10,10,20,20\n");
  EXPECT_EQ(recording.truth_of(1, 0).source, LabelSource{});
  std::ostringstream out;
  write_labels(out, recording);
  EXPECT_EQ(out.str().find("source"), std::string::npos);
}

TEST(Labels, RefuseASourceThatIsNone) {
  EXPECT_EQ(fault("frame,x,y,width,height,source\n1,10,10,20,20,detector\n"),
            "labels.csv:2: column source: \"detector\" is none of hand, spline, detector NAME, spline "
            "detector NAME");
  EXPECT_NE(fault("frame,x,y,width,height,source\n1,10,10,20,20,detector a+\n").find("without a name"),
            std::string::npos);
}

TEST(Labels, EndInAnErrorOrNotAtAllOnAnyBytes) {
  Random random(17);
  const std::string alphabet = "0123456789.,,,\n\"-ax";
  for (int i = 0; i < 5000; ++i) {
    std::string text = "frame,target,label,x,y,width,height\n0,a,visible,1,1,9,9\n";
    for (auto n = 1 + random.below(3); n > 0; --n)
      text[random.below(text.size())] = alphabet[random.below(alphabet.size())];
    fault(text);
  }
}

}  // namespace
}  // namespace relock
