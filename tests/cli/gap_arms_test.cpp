#include "cli/reproduce/gap_arms.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "core/opencv.h"
#include "sequences/open.h"
#include "tests/cli/made_comparison.h"

namespace relock::reproduction {
namespace {

constexpr std::uint64_t kSeed = 3;

Recording flight() { return made_comparison("flight", {{"still", {std::string(200, 'H')}}}).recording; }

Cut cut_of(const Recording& recording, GapArm arm) {
  return cut(arm, recording.captured, recording.period, GapPattern::parse("paper-6s"), kSeed);
}

template <class Value>
std::vector<Value> first(const std::vector<Value>& values, std::size_t count) {
  return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(GapArms, AllFramesAreShownAtTheCamerasPace) {
  const Recording recording = flight();
  const Cut all = cut_of(recording, GapArm::all_frames);
  ASSERT_EQ(all.frames.size(), recording.frames());
  for (std::size_t i = 0; i < all.frames.size(); ++i) {
    EXPECT_EQ(all.frames[i], static_cast<FrameIndex>(i));
    EXPECT_EQ(all.captured[i] - all.captured[0], static_cast<std::int64_t>(i) * recording.period);
  }
}

TEST(GapArms, GapsAreTheFramesOfJumpsAtTheTimesOfPauses) {
  const Recording recording = flight();
  const Cut all = cut_of(recording, GapArm::all_frames), pauses = cut_of(recording, GapArm::pauses),
            jumps = cut_of(recording, GapArm::jumps), gaps = cut_of(recording, GapArm::gaps);
  const std::size_t shown = gaps.frames.size();
  ASSERT_GT(shown, 50u);
  ASSERT_LT(shown, recording.frames());
  EXPECT_EQ(gaps.frames, jumps.frames);
  EXPECT_EQ(gaps.captured, first(pauses.captured, shown));
  EXPECT_EQ(jumps.captured, first(all.captured, shown));
  EXPECT_EQ(pauses.frames, all.frames);
}

TEST(GapArms, GapsShowFramesAtTheirTrueTimes) {
  const Recording recording = flight();
  const Cut gaps = cut_of(recording, GapArm::gaps);
  for (std::size_t i = 0; i < gaps.frames.size(); ++i)
    EXPECT_EQ(slots(gaps.captured[i] - gaps.captured[0] + recording.period, recording.period),
              gaps.frames[i] + 1);
}

TEST(GapArms, MissWhatTheirPatternMisses) {
  const Recording recording = flight();
  const Cut gaps = cut_of(recording, GapArm::gaps);
  const std::array<FrameIndex, 1> start{0};
  const Schedule schedule =
      GapPattern::parse("paper-6s").apply(recording.captured, recording.period, kSeed, start);
  std::vector<FrameIndex> delivered;
  for (std::size_t i = 0; i < schedule.frames(); ++i)
    if (schedule.delivered(i)) delivered.push_back(static_cast<FrameIndex>(i));
  EXPECT_EQ(gaps.frames, delivered);
}

TEST(GapArms, KeepTheTruthOfTheirFrames) {
  const Recording recording = flight();
  const Cut gaps = cut_of(recording, GapArm::gaps);
  const Recording truth = cut_recording(recording, gaps, "gaps");
  ASSERT_EQ(truth.frames(), gaps.frames.size());
  for (std::size_t i = 0; i < truth.frames(); ++i)
    EXPECT_EQ(truth.truth_of(i, 0).blur->x,
              recording.truth_of(static_cast<std::size_t>(gaps.frames[i]), 0).blur->x);
}

/// A folder that is removed in the end.
struct Folder {
  std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "relock-gap-arms";
  Folder() { std::filesystem::remove_all(path), std::filesystem::create_directories(path / "flight/images"); }
  ~Folder() { std::filesystem::remove_all(path); }
};

TEST(AWrittenCut, IsARecordingThatShowsTheFlightsFrames) {
  const Folder folder;
  const Recording recording = up_to(flight(), 40);
  for (int i = 0; i < 40; ++i)
    cv::imwrite((folder.path / "flight/images" / fmt::format("{:06}.png", i)).string(),
                cv::Mat(recording.picture.height, recording.picture.width, CV_8UC1, cv::Scalar(5 * i)));
  const Cut gaps = cut_of(recording, GapArm::gaps);
  write_cut(folder.path / "flight", cut_recording(recording, gaps, "gaps"), gaps, folder.path / "gaps");
  const Sequence sequence = open_sequence(folder.path / "gaps");
  EXPECT_EQ(sequence.recording.captured, gaps.captured);
  EXPECT_EQ(sequence.recording.period, recording.period);
  const auto frames = sequence.frames();
  for (const FrameIndex frame : gaps.frames) {
    ASSERT_TRUE(frames->next());
    EXPECT_EQ(read_only_mat(frames->image()).at<unsigned char>(0, 0), 5 * frame);
  }
  EXPECT_FALSE(frames->next());
}

}  // namespace
}  // namespace relock::reproduction
