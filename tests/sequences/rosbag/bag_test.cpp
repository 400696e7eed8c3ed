#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/opencv.h"
#include "sequences/open.h"
#include "tests/sequences/rosbag/write_bag.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

constexpr std::int64_t kEpoch = 1'700'000'000'000'000'000, kPeriod = 33'333'333;

cv::Mat gray(int level, int width = 64, int height = 48) {
  return cv::Mat(height, width, CV_8UC1, cv::Scalar(level));
}

/// A picture of one colour, as it is to be shown.
cv::Mat colour() { return cv::Mat(48, 64, CV_8UC3, cv::Scalar(200, 100, 20)); }

std::vector<int> levels(FrameSource& source) {
  std::vector<int> all;
  while (source.next()) all.push_back(source.image().row(7)[0]);
  return all;
}

class RosBag : public testing::Test {
 protected:
  /// Ten grey pictures with a gap of 0.3 s before the sixth.
  std::vector<BagMessage> flight(const std::string& topic = "/camera/image") const {
    std::vector<BagMessage> messages;
    for (int i = 0; i < 10; ++i)
      messages.push_back(image_message(topic, kEpoch + (i < 5 ? i : i + 8) * kPeriod, gray(10 + i), "mono8"));
    return messages;
  }
  Sequence open(const OpenOptions& options = {}) const { return open_sequence(bag, options); }
  std::string fault(const OpenOptions& options = {}) const {
    return fault_of([&] { open(options); });
  }
  const Scratch scratch;
  const std::filesystem::path bag = scratch.path() / "flight.bag";
};

TEST_F(RosBag, GivesTheStampsOfTheHeadersHoweverItIsPacked) {
  for (const BagPacking packing : {BagPacking::none, BagPacking::bzip2, BagPacking::lz4}) {
    write_bag(bag, flight(), packing);
    const Sequence sequence = open();
    EXPECT_EQ(sequence.format, "rosbag");
    EXPECT_EQ(sequence.recording.name, "flight");
    EXPECT_EQ(ns(sequence.recording.captured[0]), kEpoch) << "not 12 ms later, when it was recorded";
    EXPECT_EQ((sequence.recording.captured[5] - sequence.recording.captured[4]).count(), 9 * kPeriod);
    EXPECT_EQ(sequence.recording.period.count(), kPeriod);
    EXPECT_EQ(levels(*sequence.frames()), (std::vector<int>{10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
  }
}

TEST_F(RosBag, ShowsEveryEncodingInTheSameColours) {
  cv::Mat rgb, bgra, rgba;
  cv::cvtColor(colour(), rgb, cv::COLOR_BGR2RGB);
  cv::cvtColor(colour(), bgra, cv::COLOR_BGR2BGRA);
  cv::cvtColor(colour(), rgba, cv::COLOR_BGR2RGBA);
  const auto bayer = [](int blue_x, int blue_y) {  // red lies diagonally across from blue
    cv::Mat mosaic(48, 64, CV_8UC1, cv::Scalar(100));
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) {
        if (x % 2 == blue_x && y % 2 == blue_y) mosaic.at<std::uint8_t>(y, x) = 200;
        if (x % 2 != blue_x && y % 2 != blue_y) mosaic.at<std::uint8_t>(y, x) = 20;
      }
    return mosaic;
  };
  std::int64_t stamp = kEpoch;
  const auto next = [&] { return stamp += kPeriod; };
  write_bag(bag, {image_message("/c", next(), colour(), "bgr8"), image_message("/c", next(), rgb, "rgb8"),
                  image_message("/c", next(), bgra, "bgra8", 5), image_message("/c", next(), rgba, "rgba8"),
                  image_message("/c", next(), bayer(0, 0), "bayer_bggr8"),
                  image_message("/c", next(), bayer(1, 1), "bayer_rggb8"),
                  image_message("/c", next(), bayer(1, 0), "bayer_gbrg8"),
                  image_message("/c", next(), bayer(0, 1), "bayer_grbg8")});
  const auto frames = open().frames();
  while (const auto stamp_of_frame = frames->next()) {
    const std::uint8_t* pixel = frames->image().row(20) + 3 * 30;
    EXPECT_EQ(std::vector<int>(pixel, pixel + 3), (std::vector<int>{200, 100, 20})) << stamp_of_frame->index;
  }
}

TEST_F(RosBag, ReadsCompressedPictures) {
  write_bag(bag, {compressed_message("/c/compressed", kEpoch, colour(), "png"),
                  compressed_message("/c/compressed", kEpoch + kPeriod, colour(), "jpg")});
  const auto frames = open().frames();
  for (int i = 0; i < 2; ++i) {
    frames->next();
    EXPECT_NEAR(frames->image().row(20)[0], 200, 3);
    EXPECT_NEAR(frames->image().row(20)[2], 20, 3);
  }
}

TEST_F(RosBag, OrdersFramesByStampWhereTransportHasSwappedThem) {
  auto messages = flight();
  std::swap(messages[3].recorded_ns, messages[4].recorded_ns);
  std::swap(messages[3], messages[4]);
  write_bag(bag, messages);
  EXPECT_EQ(levels(*open().frames()), (std::vector<int>{10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
}

TEST_F(RosBag, RefusesStampsThatRepeatOrGoFarBack) {
  auto messages = flight();
  messages[4] = image_message("/c", messages[3].stamp_ns, gray(1), "mono8");
  messages[4].topic = messages[3].topic;
  write_bag(bag, messages);
  EXPECT_NE(fault().find("messages 3 and 4 of /camera/image have the same header stamp"), std::string::npos)
      << fault();
  messages = flight();
  const std::int64_t recorded = messages[6].recorded_ns;
  messages[6] = image_message("/camera/image", kEpoch - 3'000'000'000, gray(1), "mono8");
  messages[6].recorded_ns = recorded;
  write_bag(bag, messages);
  EXPECT_NE(fault().find("message 6 of /camera/image"), std::string::npos) << fault();
  EXPECT_NE(fault().find("goes back by"), std::string::npos);
  // Unless a sidecar has better ones.
  std::string times = "timestamp_ns\n";
  for (int i = 0; i < 10; ++i) times += fmt::format("{}\n", i);
  scratch.write("flight.timestamps.csv", times);
  EXPECT_EQ(ns(open().recording.captured[9]), 9);
}

TEST_F(RosBag, WithSeveralTopicsOfPicturesAsksForOne) {
  auto messages = flight("/left"), right = flight("/right");
  messages.insert(messages.end(), right.begin() + 2, right.end());
  write_bag(bag, messages);
  EXPECT_NE(
      fault().find("choose one with --topic: /left (10 sensor_msgs/Image), /right (8 sensor_msgs/Image)"),
      std::string::npos)
      << fault();
  OpenOptions options;
  options.topic = "/right";
  EXPECT_EQ(open(options).recording.frames(), 8u);
  options.topic = "/up";
  EXPECT_NE(fault(options).find("has no topic /up; those of pictures are /left"), std::string::npos);
}

TEST_F(RosBag, NamesTheMessageThatIsNoPictureAndShowsThoseBefore) {
  const auto fault_after_one = [&](const BagMessage& second) {
    write_bag(bag, {image_message("/c", kEpoch, gray(10), "mono8"), second});
    const auto frames = open().frames();
    frames->next();
    EXPECT_EQ(frames->image().row(0)[0], 10);
    frames->next();
    return fault_of([&] { frames->image(); });
  };
  const cv::Mat wide(48, 64, CV_16UC1, cv::Scalar(1000));
  EXPECT_NE(fault_after_one(image_message("/c", kEpoch + 1, wide, "mono16"))
                .find("flight.bag: message 1 of /c: its encoding \"mono16\" has more than 8 bits a channel"),
            std::string::npos);
  EXPECT_NE(fault_after_one(image_message("/c", kEpoch + 1, gray(1), "x")).find("is none that relock reads"),
            std::string::npos);
  EXPECT_NE(fault_after_one(image_message("/c", kEpoch + 1, gray(1, 32, 48), "mono8"))
                .find("this picture is 32x48 and the first one 64x48"),
            std::string::npos);
  EXPECT_NE(
      fault_after_one(image_message("/c", kEpoch + 1, gray(1), "bgr8")).find("it has 3072 bytes and says"),
      std::string::npos);
  BagMessage cut = image_message("/c", kEpoch + 1, gray(1), "mono8");
  cut.bytes.resize(cut.bytes.size() - 9);
  EXPECT_NE(fault_after_one(cut).find("ends too early"), std::string::npos);
}

TEST_F(RosBag, ThatIsNoneOrCutOffIsTold) {
  scratch.write("flight.bag", "no bag");
  EXPECT_NE(fault().find("flight.bag is no ROS 1 bag, or is cut off"), std::string::npos) << fault();
  scratch.write("flight.bag", "");
  EXPECT_NE(fault().find("flight.bag is no ROS 1 bag, or is cut off"), std::string::npos) << fault();
  write_bag(bag, flight(), BagPacking::lz4);
  std::filesystem::resize_file(bag, std::filesystem::file_size(bag) / 2);
  EXPECT_NE(fault().find("rosbag reindex"), std::string::npos) << fault();
  write_bag(bag, {});
  EXPECT_NE(fault().find("holds no pictures"), std::string::npos) << fault();
}

TEST_F(RosBag, TakesItsLabelsFromBesideIt) {
  write_bag(bag, flight());
  scratch.write("flight.labels.csv", "frame,x,y,width,height\n9,1,1,9,9\n");
  EXPECT_EQ(open().recording.targets.size(), 1u);
}

}  // namespace
}  // namespace relock
