#include "sequences/simulator/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <thread>

#include "core/display_coding.h"
#include "sequences/simulator/sensor_noise.h"
#include "tests/sequences/scratch.h"

namespace relock::simulator {
namespace {

constexpr SensorPlan kIdeal{.full_well_e = 0, .read_noise_e = 0, .vignetting = 0, .defocus_px = 0};

cv::Mat even_light(double light, cv::Size size = {640, 360}) {
  return {size, CV_32FC3, cv::Scalar::all(light)};
}

/// Light that changes from pixel to pixel and channel to channel.
cv::Mat ramps(cv::Size size = {64, 48}) {
  cv::Mat3f light(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      light(y, x) = {static_cast<float>(x) / 64, static_cast<float>(y) / 48,
                     static_cast<float>((x * y) % 97) / 97};
  return light;
}

cv::Mat developed(const cv::Mat& light, const SensorPlan& plan, double gain = 1, std::uint64_t seed = 1) {
  cv::Mat used_up = light.clone(), out;
  develop(used_up, plan, gain, seed, out);
  return out;
}

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

struct MeanAndVariance {
  double mean, variance;
};
MeanAndVariance spread(const cv::Mat& picture) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture.reshape(1), mean, deviation);
  return {mean[0] / 255, deviation[0] * deviation[0] / (255 * 255)};
}

TEST(Sensor, ThatIsIdealGivesTheExactCodedLight) {
  const cv::Mat light = ramps();
  const cv::Mat out = developed(light, kIdeal);
  ASSERT_EQ(out.type(), CV_8UC3);
  for (int y = 0; y < light.rows; ++y)
    for (int i = 0; i < 3 * light.cols; ++i)
      ASSERT_EQ(out.ptr(y)[i], std::lround(255 * coded_of_light(light.ptr<float>(y)[i])));
}

TEST(Sensor, GivesEveryByteBackThatWasLight) {
  cv::Mat light(1, 256, CV_32FC3), linear(1, 256, CV_32FC3);
  for (int i = 0; i < 256; ++i) {
    light.at<cv::Vec3f>(i) = cv::Vec3f::all(static_cast<float>(light_of_coded(i / 255.0)));
    linear.at<cv::Vec3f>(i) = cv::Vec3f::all(static_cast<float>(i) / 255);
  }
  SensorPlan no_coding = kIdeal;
  no_coding.srgb = false;
  const cv::Mat coded = developed(light, kIdeal), plain = developed(linear, no_coding);
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(coded.at<cv::Vec3b>(i)[1], i);
    EXPECT_EQ(plain.at<cv::Vec3b>(i)[2], i);
  }
}

TEST(Sensor, HasNoiseWhoseVarianceFollowsTheStatedLine) {
  SensorPlan plan = kIdeal;
  plan.srgb = false;  // bytes are the signal
  plan.full_well_e = 900;
  plan.read_noise_e = 15;
  const double samples = 3 * 640 * 360, rounding = 1 / (12.0 * 255 * 255);
  for (const double gain : {1.0, 2.0, 0.5})
    for (const double light : {0.15, 0.25, 0.4}) {
      const MeanAndVariance found = spread(developed(even_light(light), plan, gain, 7));
      const double signal = gain * light, reading = gain * plan.read_noise_e / plan.full_well_e;
      const double variance = gain * signal / plan.full_well_e + reading * reading + rounding;
      EXPECT_NEAR(found.variance / variance, 1, 4 * std::sqrt(2 / samples)) << gain << " " << light;
      EXPECT_NEAR(found.mean, signal, 4 * std::sqrt(variance / samples)) << "noise moves no mean";
    }
}

TEST(Sensor, HasNoiseThatPixelsChannelsAndFramesDoNotShare) {
  SensorPlan plan = kIdeal;
  plan.srgb = false;
  plan.full_well_e = 500;
  const auto noise = [&](std::uint64_t seed) {
    cv::Mat signal;
    developed(even_light(0.5), plan, 1, seed).convertTo(signal, CV_32F, 1, -127.5);
    return signal;
  };
  const auto correlation = [](const cv::Mat& a, const cv::Mat& b) {
    return a.clone().dot(b.clone()) / std::sqrt(a.dot(a) * b.dot(b));
  };
  const cv::Mat frame = noise(1), next = noise(2);
  const double limit = 5 / std::sqrt(639.0 * 359);
  EXPECT_NEAR(correlation(frame, next), 0, limit);
  EXPECT_NEAR(correlation(frame.colRange(0, 639), frame.colRange(1, 640)), 0, limit);
  EXPECT_NEAR(correlation(frame.rowRange(0, 359), frame.rowRange(1, 360)), 0, limit);
  std::vector<cv::Mat> colour;
  cv::split(frame, colour);
  EXPECT_NEAR(correlation(colour[0], colour[1]), 0, limit);
  EXPECT_NEAR(correlation(colour[1], colour[2]), 0, limit);
}

TEST(Sensor, LosesTheStatedShareInTheCornersAndNothingInTheMiddle) {
  SensorPlan plan = kIdeal;
  plan.srgb = false;
  plan.vignetting = 0.4;
  const cv::Mat out = developed(even_light(1, {641, 361}), plan);
  EXPECT_EQ(out.at<cv::Vec3b>(180, 320)[0], 255);
  for (const cv::Point corner : {cv::Point(0, 0), cv::Point(640, 0), cv::Point(0, 360), cv::Point(640, 360)})
    EXPECT_EQ(out.at<cv::Vec3b>(corner)[1], std::lround(255 * 0.6));
  for (int x = 321; x < 641; ++x)
    EXPECT_LE(out.at<cv::Vec3b>(180, x)[2], out.at<cv::Vec3b>(180, x - 1)[2]) << "it falls off outwards";
}

TEST(Sensor, BlursWithTheStatedVarianceAndLosesNoLight) {
  for (const double sigma : {0.3, 0.4, 1.0, 2.5}) {
    SensorPlan plan = kIdeal;
    plan.srgb = false;
    plan.defocus_px = sigma;
    cv::Mat light(41, 41, CV_32FC3, cv::Scalar::all(0)), out;
    light.at<cv::Vec3f>(20, 20) = cv::Vec3f::all(1);
    develop(light, plan, 1, 1, out);  // the light is the blurred one now
    double sum = 0, square = 0;
    for (int y = 0; y < 41; ++y)
      for (int x = 0; x < 41; ++x) {
        const double here = light.at<cv::Vec3f>(y, x)[0];
        sum += here, square += here * (x - 20) * (x - 20);
      }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_NEAR(square / (sigma * sigma), 1, 0.02) << sigma;
  }
}

TEST(Sensor, GivesTheSameBytesForTheSameSeedOnAnyThread) {
  SensorPlan plan;
  plan.sharpening = 0.5;
  const cv::Mat light = ramps({333, 77});
  const cv::Mat first = developed(light, plan, 1.5, 42);
  cv::Mat elsewhere;
  std::thread([&] { elsewhere = developed(light, plan, 1.5, 42); }).join();
  EXPECT_TRUE(same(first, elsewhere));
  EXPECT_FALSE(same(first, developed(light, plan, 1.5, 43)));
}

TEST(Sensor, SharpensEdgesAndLeavesEvenLightAlone) {
  SensorPlan plan = kIdeal;
  plan.sharpening = 1;
  EXPECT_TRUE(same(developed(even_light(0.2), plan), developed(even_light(0.2), kIdeal)));
  cv::Mat edge = even_light(0.2, {32, 8});
  edge.colRange(16, 32).setTo(cv::Scalar::all(0.4));
  const cv::Mat soft = developed(edge, kIdeal), sharp = developed(edge, plan);
  EXPECT_LT(sharp.at<cv::Vec3b>(4, 15)[0], soft.at<cv::Vec3b>(4, 15)[0]);
  EXPECT_GT(sharp.at<cv::Vec3b>(4, 16)[0], soft.at<cv::Vec3b>(4, 16)[0]);
}

TEST(Sensor, NamesThePartOfItsPlanThatIsOutOfRange) {
  SensorPlan plan;
  EXPECT_EQ(fault_of([&] { check_sensor(plan); }), "");
  plan.vignetting = 1;
  EXPECT_NE(fault_of([&] { check_sensor(plan); }).find("sensor: vignetting is 1; it must be from 0 to 0.99"),
            std::string::npos);
  plan = {};
  plan.read_noise_e = NAN;
  EXPECT_NE(fault_of([&] { check_sensor(plan); }).find("read_noise_e"), std::string::npos);
}

TEST(Noise, IsStandardNormal) {
  double sum = 0, squares = 0, fourths = 0, below_one = 0;
  const auto count = static_cast<double>(normal_table().size());
  for (const float z : normal_table()) {
    const double s = z;
    sum += s, squares += s * s, fourths += s * s * s * s;
    below_one += s < 1 ? 1 : 0;
  }
  EXPECT_EQ(sum, 0);
  EXPECT_NEAR(squares / count, 1, 1e-5);
  EXPECT_NEAR(fourths / count, 3, 0.01);
  EXPECT_NEAR(below_one / count, 0.841345, 1e-4);
}

}  // namespace
}  // namespace relock::simulator
