#include "cli/camera_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "cli/poses.h"
#include "sequences/simulator/camera.h"
#include "tests/fault.h"

namespace relock {
namespace {

class CameraFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path written(const std::string& text, const std::string& name = "camera.yaml") const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string fault(const std::string& text) const {
    return fault_of([&] { read_camera(written(text)); });
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      ("relock-camera-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(CameraFile, OfTheSimulatorIsRead) {
  simulator::Camera camera{{640, 360}, 354.5, -0.1, 0.02};
  const pose::Camera read = read_camera(written(calibration_text(camera)));
  EXPECT_EQ(read.picture, camera.picture);
  EXPECT_EQ(read.fx, 354.5);
  EXPECT_EQ(read.cx, camera.middle().x);
  EXPECT_EQ(read.cy, camera.middle().y);
  EXPECT_EQ(read.distortion, (std::array<double, 5>{-0.1, 0.02, 0, 0, 0}));
}

TEST_F(CameraFile, OfRosIsRead) {
  const pose::Camera read = read_camera(written(
      "image_width: 640\nimage_height: 480\ncamera_name: narrow\ncamera_matrix:\n  rows: 3\n  cols: 3\n  "
      "data: [430.15, 0.0, 306.7, 0.0, 430.5, 227.2, 0.0, 0.0, 1.0]\ndistortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.33, 0.1, 0.001, -0.0001, 0.0]\n"));
  EXPECT_EQ(read.picture, (Size{640, 480}));
  EXPECT_EQ(read.fy, 430.5);
  EXPECT_EQ(read.distortion[3], -0.0001);
}

TEST_F(CameraFile, ThatIsNoneIsRefusedInOneSentence) {
  EXPECT_NE(fault("a: 1\n").find("camera_matrix with its 9 numbers is missing"), std::string::npos);
  EXPECT_NE(fault("camera_matrix: [1, 2\n").find("cannot be read as a calibration"), std::string::npos);
  EXPECT_NE(fault("camera_matrix:\n  data: [0, 0, 3, 0, 5, 4, 0, 0, 1]\n").find("focal lengths above 0"),
            std::string::npos);
  EXPECT_NE(fault("camera_matrix:\n  data: [5, 0, 3, 0, 5, 4, 0, 0, 1]\ndistortion_model: equidistant\n")
                .find("only plumb_bob"),
            std::string::npos);
  EXPECT_NE(fault("camera_matrix:\n  data: [5, 0, 3, 0, 5, 4, 0, 0, 1]\ndistortion_coefficients:\n  data: "
                  "[0, 0, 0, 0, 0, 1, 2, 3]\n")
                .find("has 8 numbers"),
            std::string::npos);
}

TEST_F(CameraFile, OfALayoutNamesThePlaceOfAMistake) {
  const auto layout_fault = [&](const std::string& text) {
    return fault_of([&] { read_layout(written(text, "plate.toml")); });
  };
  EXPECT_NE(layout_fault("[[marker]]\ncode = \"ring2:00\"\nx_m = 1\n").find("plate.toml:1:"),
            std::string::npos);
  EXPECT_NE(layout_fault("[[marker]]\ncode = \"ring2:00\"\nx_m = 0\ny_m = 0\n").find("four markers or more"),
            std::string::npos);
  EXPECT_NE(layout_fault("[[marker]]\ncod = \"ring2:00\"\n").find("did you mean \"code\""),
            std::string::npos);
}

}  // namespace
}  // namespace relock
