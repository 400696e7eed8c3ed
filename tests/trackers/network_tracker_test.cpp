#include "trackers/network_tracker.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core/version.hpp>

#include "core/error.h"
#include "tests/fault.h"
#include "tests/trackers/moving_patch.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr Vec2 kStart{40, 46};

class NetworkTracker : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  std::string folder() const { return folder_.string(); }

 private:
  fs::path folder_ =
      fs::path(testing::TempDir()) /
      ("relock-network-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(NetworkTracker, WithoutItsFileSaysWhichOptionIsMissingAndWhereSuchFilesAre) {
  const std::string said = fault_of([] { dasiamrpn_tracker({}); });
  EXPECT_TRUE(mentions(said, "dasiamrpn: option model is not given")) << said;
  EXPECT_TRUE(mentions(said, "model zoo")) << said;
  EXPECT_TRUE(mentions(fault_of([] { goturn_tracker({}); }), "goturn: option model is not given"));
}

TEST_F(NetworkTracker, NamesTheFileThatDoesNotExistIsAFolderOrEmpty) {
  const std::string some = file("some.onnx", "x"), empty = file("empty.onnx", "");
  const std::string missing = fault_of([&] { dasiamrpn_tracker({some, folder() + "/none.onnx", some}); });
  EXPECT_TRUE(mentions(missing, "option kernel_cls1 is " + folder() + "/none.onnx, which does not exist"))
      << missing;
  EXPECT_TRUE(mentions(fault_of([&] { goturn_tracker({folder(), some}); }), "is a folder"));
  EXPECT_TRUE(mentions(fault_of([&] { goturn_tracker({some, empty}); }), "option weights is " + empty));
}

TEST_F(NetworkTracker, SaysInOneSentenceThatAFileIsNoNetwork) {
  const std::string junk = file("junk.onnx", "this is\nno network\n");
  const std::string said = fault_of([&] { dasiamrpn_tracker({junk, junk, junk}); });
  EXPECT_TRUE(mentions(said, junk + " is no network that OpenCV")) << said;
  EXPECT_FALSE(mentions(said, "\n")) << said;
}

TEST_F(NetworkTracker, SaysWhichOpenCvItNeedsWhenThisOneIsTooOld) {
  if (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 7) {
    EXPECT_TRUE(mentions(fault_of([] { nano_tracker({}); }),
                         "nano needs OpenCV 4.7 or newer; this relock was built with 4."));
    EXPECT_TRUE(mentions(nano_needs(), "OpenCV 4.7"));
  } else {
    EXPECT_TRUE(mentions(fault_of([] { nano_tracker({}); }), "nano: option backbone is not given"));
  }
  if (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 9) {
    EXPECT_TRUE(mentions(fault_of([] { vit_tracker({}); }),
                         "vit needs OpenCV 4.9 or newer; this relock was built with 4."));
  } else {
    EXPECT_TRUE(mentions(fault_of([] { vit_tracker({}); }), "vit: option model is not given"));
  }
}

// A network with GOTURN's inputs and output that answers with the middle half of the search patch, which is
// where the target was: it stands still.
constexpr const char* kStill = R"(name: "still"
input: "data1" input_shape { dim: 1 dim: 3 dim: 227 dim: 227 }
input: "data2" input_shape { dim: 1 dim: 3 dim: 227 dim: 227 }
layer { name: "both" type: "Eltwise" bottom: "data1" bottom: "data2" top: "both" }
layer { name: "mean" type: "Pooling" bottom: "both" top: "mean" pooling_param { pool: AVE global_pooling: true } }
layer { name: "cut" type: "Slice" bottom: "mean" top: "two" top: "one" slice_param { axis: 1 slice_point: 2 } }
layer { name: "low" type: "Power" bottom: "two" top: "low" power_param { scale: 0 shift: 56.75 } }
layer { name: "high" type: "Power" bottom: "two" top: "high" power_param { scale: 0 shift: 170.25 } }
layer { name: "corners" type: "Concat" bottom: "low" bottom: "high" top: "corners" concat_param { axis: 1 } }
layer { name: "scale" type: "Power" bottom: "corners" top: "scale" power_param { scale: 1 } }
)";

TEST_F(NetworkTracker, GoturnSaysWhatItsNetworkSays) {
  const GoturnOptions files{file("still.prototxt", kStill), file("still.caffemodel", "\x0a\x05still")};
  const auto tracker = goturn_tracker(files), other = goturn_tracker(files);
  const cv::Mat picture = patch_at(kStart), next = patch_at(kStart + Vec2{3, 1});
  tracker->start(frame_of(picture, 0), patch_box(kStart));
  for (FrameIndex i = 1; i <= 3; ++i) {
    const auto sighting = tracker->track(frame_of(next, i));
    ASSERT_TRUE(sighting);
    EXPECT_GT(intersection_over_union(std::get<Box>(sighting->outline), patch_box(kStart)), 0.9);
  }
  EXPECT_THROW(other->track(frame_of(picture, 0)), Error);
  EXPECT_THROW(tracker->track(Frame{}), Error);
}

}  // namespace
}  // namespace relock
