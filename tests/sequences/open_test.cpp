#include "sequences/open.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "sequences/image_folder.h"
#include "source_folder.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

const std::string kSteady = "rate_hz = 30\n";

/// The grey levels of all pictures, in the order in which they come.
std::vector<int> levels(FrameSource& source) {
  std::vector<int> all;
  while (source.next()) all.push_back(source.image().row(0)[0]);
  return all;
}

TEST(ImageFolder, TakesPicturesInTheOrderOfTheirNumbers) {
  const Scratch scratch;
  scratch.write_pictures(12);  // 0.png … 11.png: "10" comes before "2" by letters
  scratch.write("recording.toml", kSteady);
  const auto frames = open_sequence(scratch.path()).frames();
  EXPECT_EQ(levels(*frames), (std::vector<int>{10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21}));
}

TEST(ImageFolder, GivesTheTimesOfTimestampsCsvAndTheirPeriod) {
  const Scratch scratch;
  scratch.write_pictures(4);
  scratch.write("timestamps.csv", "timestamp_ns\n1000\n34000\n67000\n200000\n");
  const Sequence sequence = open_sequence(scratch.path());
  EXPECT_EQ(ns(sequence.recording.captured[3]), 200000);
  EXPECT_EQ(sequence.recording.period, Duration(33000));
  EXPECT_FALSE(sequence.period_stated);
}

TEST(ImageFolder, PutsTimesAtAStatedRateWithoutAddingUpRoundings) {
  const Scratch scratch;
  scratch.write_pictures(4);
  OpenOptions options;
  options.rate_hz = 30;
  EXPECT_EQ(ns(open_sequence(scratch.path(), options).recording.captured[3]), 100'000'000);
}

TEST(ImageFolder, RefusesTimesThatRepeatOrGoBackwards) {
  const Scratch scratch;
  scratch.write_pictures(3);
  scratch.write("timestamps.csv", "timestamp_ns\n1000\n2000\n2000\n");
  EXPECT_NE(fault_of([&] { open_sequence(scratch.path()); }).find("timestamps.csv:4: the time 2000 repeats"),
            std::string::npos);
  scratch.write("timestamps.csv", "timestamp_ns\n1000\n2000\n1500\n");
  EXPECT_NE(fault_of([&] { open_sequence(scratch.path()); }).find("goes back behind"), std::string::npos);
  scratch.write("timestamps.csv", "timestamp_ns\n1000\n2000\n");
  EXPECT_NE(fault_of([&] { open_sequence(scratch.path()); }).find("2 times for 3 pictures"),
            std::string::npos);
}

TEST(ImageFolder, NamesAPictureThatCannotBeReadAndReadsTheOnesBefore) {
  const Scratch scratch;
  scratch.write_pictures(5);
  scratch.write("recording.toml", kSteady);
  scratch.write("images/3.png", "no picture");
  const auto frames = open_sequence(scratch.path()).frames();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(frames->next());
    EXPECT_EQ(frames->image().row(0)[0], 10 + i);
  }
  frames->next();
  EXPECT_NE(fault_of([&] { frames->image(); }).find("3.png: this is no picture"), std::string::npos);
}

TEST(ImageFolder, NamesAPictureThatIsAFolder) {
  const Scratch scratch;
  scratch.write_pictures(2);
  std::filesystem::create_directories(scratch.path() / "images/x.png");
  scratch.write("timestamps.csv", "timestamp_ns,file\n0,0.png\n33,x.png\n");
  EXPECT_NE(fault_of([&] { open_sequence(scratch.path()); }).find("x.png cannot be read"), std::string::npos);
}

TEST(ImageFolder, RefusesAClockThatJumps) {
  const Scratch scratch;
  scratch.write_pictures(2);
  scratch.write("timestamps.csv", "timestamp_ns\n0\n1700000000000000000\n");
  EXPECT_NE(fault_of([&] {
              open_sequence(scratch.path());
            }).find("timestamps.csv:3: the time jumps by 1700000000 s"),
            std::string::npos);
}

TEST(ImageFolder, NamesAPictureOfAnotherSize) {
  const Scratch scratch;
  scratch.write_pictures(2);
  const Scratch other;
  other.write_pictures(1, 32, 48);
  std::filesystem::copy(other.path() / "images/0.png", scratch.path() / "images/7.png");
  scratch.write("recording.toml", kSteady);
  const auto frames = open_sequence(scratch.path()).frames();
  EXPECT_NE(fault_of([&] { levels(*frames); }).find("7.png: this picture is 32x48 and the first one 64x48"),
            std::string::npos);
}

TEST(ImageFolder, NamesAJpegThatIsCutOff) {
  const Scratch scratch;
  std::filesystem::create_directories(scratch.path() / "images");
  std::filesystem::copy(RELOCK_SOURCE_DIR "/recordings/klahaag/images/00001.jpg",
                        scratch.path() / "images/1.jpg");
  std::filesystem::copy(RELOCK_SOURCE_DIR "/recordings/klahaag/images/00002.jpg",
                        scratch.path() / "images/2.jpg");
  std::filesystem::resize_file(scratch.path() / "images/2.jpg", 9000);
  scratch.write("recording.toml", kSteady);
  const auto frames = open_sequence(scratch.path()).frames();
  EXPECT_NE(fault_of([&] { levels(*frames); }).find("2.jpg: this picture is cut off after 9000 bytes"),
            std::string::npos);
}

TEST(ImageFolder, HoldsOnePictureAtATimeHoweverLongTheRecording) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer keeps what is freed";
#endif
  const Scratch scratch;
  std::filesystem::create_directories(scratch.path() / "images");
  for (int i = 0; i < 400; ++i)
    std::filesystem::create_symlink(RELOCK_SOURCE_DIR "/recordings/klahaag/images/00001.jpg",
                                    scratch.path() / "images" / (std::to_string(i) + ".jpg"));
  scratch.write("recording.toml", kSteady);
  const auto frames = open_sequence(scratch.path()).frames();
  const auto peak_mb = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_maxrss) / 1024;
  };
  for (int i = 0; i < 20; ++i) frames->next(), frames->image();
  const double before = peak_mb();
  while (frames->next()) frames->image();
  EXPECT_LT(peak_mb() - before, 30) << "380 pictures are 250 MB";
}

TEST(Recording, ThatIsNoneIsTold) {
  const Scratch scratch;
  EXPECT_NE(fault_of([&] { open_sequence(scratch.path() / "none"); }).find("does not exist"),
            std::string::npos);
  EXPECT_NE(fault_of([&] { open_sequence(scratch.path()); }).find("holds no pictures"), std::string::npos);
  scratch.write_pictures(1);
  EXPECT_NE(fault_of([&] { open_sequence(scratch.path()); }).find("says nothing of time"), std::string::npos);
}

TEST(Description, NamesLineAndColumnOfAMistake) {
  const Scratch scratch;
  scratch.write_pictures(2);
  scratch.write("recording.toml", "name = \"x\"\nrate = 30\n");
  EXPECT_NE(
      fault_of([&] { open_sequence(scratch.path()); }).find("recording.toml:2:1: no key is called \"rate\""),
      std::string::npos);
  scratch.write("recording.toml", "rate_hz = \"fast\"\n");
  EXPECT_NE(
      fault_of([&] { open_sequence(scratch.path()); }).find("recording.toml:1:11: rate_hz must be a number"),
      std::string::npos);
}

TEST(Fingerprint, ChangesWithAnyPictureTimeOrLabelAndWithNothingElse) {
  const Scratch scratch;
  scratch.write_pictures(3);
  scratch.write("recording.toml", kSteady);
  const std::string before = open_sequence(scratch.path()).fingerprint;
  scratch.write("notes.txt", "unrelated");
  EXPECT_EQ(open_sequence(scratch.path()).fingerprint, before);
  scratch.write("labels.csv", "frame,x,y,width,height\n0,1,1,9,9\n");
  const std::string labelled = open_sequence(scratch.path()).fingerprint;
  EXPECT_NE(labelled, before);
  scratch.write("recording.toml", kSteady + "sigma_px = 3\n");
  EXPECT_NE(open_sequence(scratch.path()).fingerprint, labelled);
  scratch.write("recording.toml", kSteady);
  scratch.write("timestamps.csv", "timestamp_ns\n0\n1\n2\n");
  EXPECT_NE(open_sequence(scratch.path()).fingerprint, labelled);
}

TEST(EmbeddedRecordings, HaveTruthOnEveryFrame) {
  for (const char* name : {"klahaag", "klahaag-prints"}) {
    const Recording recording =
        open_sequence(std::filesystem::path(RELOCK_SOURCE_DIR) / "recordings" / name).recording;
    EXPECT_EQ(recording.frames(), 53u);
    for (const TargetTruth& truth : recording.truth) EXPECT_EQ(truth.label, Label::visible);
  }
}

}  // namespace
}  // namespace relock
