#include <gtest/gtest.h>

#include <set>

#include "detectors/ring_paper/training.h"

namespace relock::ring_paper {
namespace {

TEST(TrainingProfiles, AreOfEveryCodeAtThirtySixOrientations) {
  for (const int bits : {1, 2, 3}) {
    RingPaperOptions options;
    options.bits = bits;
    const auto training = training_profiles(options);
    std::set<std::pair<std::string, int>> kinds;
    for (const TrainingProfile& profile : training) {
      kinds.insert({profile.bits, profile.orientation_deg});
      EXPECT_EQ(profile.levels.size(), 100u);
      EXPECT_TRUE(profile.orientation_deg % 10 == 0 && profile.orientation_deg < 360);
    }
    EXPECT_EQ(kinds.size(), 36u << bits);
    EXPECT_EQ(training.size(), kinds.size());
  }
}

TEST(TrainingProfiles, AreTheSameFromEitherEnd) {
  for (const TrainingProfile& profile : training_profiles({}))
    for (std::size_t i = 0; i < 50; ++i)
      EXPECT_NEAR(profile.levels[i], profile.levels[99 - i], 0.04)
          << profile.bits << " " << profile.orientation_deg;
}

TEST(TrainingProfiles, OfOneCodeAreAlikeAndThoseOfTwoCodesAreNot) {
  const auto training = training_profiles({});
  for (const TrainingProfile& a : training)
    for (const Neighbour& one :
         classify(a.levels, training, static_cast<int>(training.size()), {}).neighbours) {
      const bool same_code = training[one.rank].bits == a.bits;
      EXPECT_EQ(one.distance < 0.06, same_code) << a.bits << " " << one.distance;
      EXPECT_EQ(one.distance > 0.15, !same_code) << a.bits << " " << one.distance;
    }
}

TEST(TrainingProfiles, AreSharedByDetectorsOfTheSameOptions) {
  RingPaperOptions other;
  other.training_blur_px = 30;
  const auto first = shared_training({});
  EXPECT_EQ(first, shared_training({}));
  EXPECT_NE(first, shared_training(other));
}

std::vector<TrainingProfile> drawn_training(const std::vector<std::pair<std::string, float>>& levels) {
  std::vector<TrainingProfile> all;
  for (const auto& [bits, level] : levels) all.push_back({bits, 0, {level, level}});
  return all;
}

TEST(Classify, TakesTheCodeOfMostOfTheKNearest) {
  const auto training =
      drawn_training({{"00", 0.0F}, {"01", 0.2F}, {"01", 0.25F}, {"01", 0.9F}, {"00", 1.0F}});
  EXPECT_EQ(classify({0.05F, 0.05F}, training, 1, {}).bits, "00");
  EXPECT_EQ(classify({0.05F, 0.05F}, training, 3, {}).bits, "01");
  EXPECT_EQ(classify({0.05F, 0.05F}, training, 3, {}).votes, 2);
  EXPECT_NEAR(classify({0.05F, 0.05F}, training, 3, {}).distance(), 0.05, 1e-6);
}

TEST(Classify, TakesTheNearerOfTwoCodesWithAsManyVotes) {
  const auto training = drawn_training({{"01", 0.3F}, {"10", 0.2F}, {"01", 0.31F}, {"10", 0.35F}});
  EXPECT_EQ(classify({0.0F, 0.0F}, training, 4, {}).bits, "10");
  EXPECT_EQ(classify({0.4F, 0.4F}, training, 4, {}).bits, "10");
  EXPECT_EQ(classify({0.3F, 0.3F}, training, 4, {}).bits, "01");
}

TEST(Classify, ComparesOnlyCodesOfTheCountedRingsWhenItIsAsked) {
  const auto training = drawn_training({{"00", 0.0F}, {"01", 0.5F}, {"10", 0.6F}, {"11", 0.1F}});
  EXPECT_EQ(classify({0.0F, 0.0F}, training, 1, 2).bits, "00");
  EXPECT_EQ(classify({0.0F, 0.0F}, training, 1, 3).bits, "01");
  EXPECT_EQ(classify({0.0F, 0.0F}, training, 1, 4).bits, "11");
}

}  // namespace
}  // namespace relock::ring_paper
