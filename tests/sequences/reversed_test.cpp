#include "sequences/reversed.h"

#include <gtest/gtest.h>

#include "sequences/open.h"
#include "tests/sequences/movies.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

constexpr std::size_t kPicture = 64 * 48 * 3;  // bytes, as the budget counts them

/// The grey levels of all pictures, in the order in which they come.
std::vector<int> levels(FrameSource& source) {
  std::vector<int> all;
  while (source.next()) all.push_back(source.image().row(0)[0]);
  return all;
}

TEST(AReversedSource, GivesTheSamePicturesFromTheLastToTheFirst) {
  const Scratch scratch;
  scratch.write_pictures(7);
  scratch.write("timestamps.csv", "timestamp_ns\n100\n110\n150\n160\n170\n200\n300\n");
  const Sequence sequence = open_sequence(scratch.path());
  for (const std::size_t pictures : {0u, 1u, 3u, 7u, 100u}) {
    const auto source = reversed(sequence.frames, {.budget_bytes = pictures * kPicture});
    EXPECT_EQ(levels(*source), (std::vector<int>{16, 15, 14, 13, 12, 11, 10})) << pictures << " at a time";
    EXPECT_EQ(ns(source->captured()[0]), 100);
    EXPECT_EQ(ns(source->captured()[1]), 200);
    EXPECT_EQ(ns(source->captured()[6]), 300);
    EXPECT_FALSE(source->next());
  }
}

TEST(AReversedSource, MakesOnePassForEveryStretchThatIsLookedAt) {
  const Scratch scratch;
  scratch.write_pictures(10);
  scratch.write("recording.toml", "rate_hz = 30\n");
  const Sequence sequence = open_sequence(scratch.path());
  int passes = -1;  // one to learn size and times
  const auto counted = [&] { return ++passes, sequence.frames(); };
  const auto source = reversed(counted, {.budget_bytes = 4 * kPicture});
  while (const auto stamp = source->next())
    if (stamp->index < 6) source->image();  // recorded frames 9 8, 7 6 5 4; the first stretch is left alone
  EXPECT_EQ(passes, 2);
}

TEST(AReversedSource, TellsOfAPictureThatCannotBeReadWhereItIs) {
  const Scratch scratch;
  scratch.write_pictures(4);
  scratch.write("images/2.png", "no picture");
  scratch.write("recording.toml", "rate_hz = 30\n");
  const auto source = reversed(open_sequence(scratch.path()).frames);
  source->next();
  EXPECT_EQ(source->image().row(0)[0], 13);
  source->next();
  EXPECT_NE(fault_of([&] { source->image(); }).find("2.png"), std::string::npos);
  source->next();
  EXPECT_EQ(source->image().row(0)[0], 11);
}

TEST(AReversedSource, OfAVideoShowsTheSlotsOfItsTimes) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  const Scratch scratch;
  const auto movie = scratch.path() / "gaps.mp4";
  ffmpeg(barred(90) + " " + kGaps + " " + movie.string());
  const Sequence sequence = open_sequence(movie);
  auto expected = slots_of_pictures(*sequence.frames());
  std::reverse(expected.begin(), expected.end());
  EXPECT_EQ(slots_of_pictures(*reversed(sequence.frames, {.budget_bytes = 10 * kPicture})), expected);
}

}  // namespace
}  // namespace relock
