// Benchmark folders as recordings: tests/data/formats has one of each, whose target is on columns 4 to 13,
// 6 to 15, … of rows 6 to 13.

#include "sequences/format.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/random.h"
#include "sequences/timestamps.h"
#include "sequences/vot_region.h"
#include "source_folder.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

const fs::path kSamples = fs::path(RELOCK_SOURCE_DIR) / "tests/data/formats";

/// The outline of the target on the frame of that rank.
Box drawn(int frame) { return {3.5 + 2 * frame, 5.5, 10, 8}; }

Sequence opened(const fs::path& path, const std::string& format = "") {
  OpenOptions options;
  if (!format.empty()) options.format = format;
  return open_sequence(path, options);
}

std::vector<std::int64_t> intervals_ms(const Sequence& sequence) {
  std::vector<std::int64_t> all;
  const auto& times = sequence.recording.captured;
  for (std::size_t i = 1; i < times.size(); ++i) all.push_back((times[i] - times[i - 1]).count() / 1'000'000);
  return all;
}

std::string labels_of(const Recording& recording, std::size_t target = 0) {
  std::string letters;
  for (std::size_t i = 0; i < recording.frames(); ++i)
    letters += to_string(recording.truth_of(i, target).label)[0];
  return letters;  // v, a, u
}

void copy(const fs::path& from, const Scratch& to, const std::string& name) {
  fs::copy(from, to.path() / name, fs::copy_options::recursive);
}

TEST(Formats, AreRecognisedByTheirLooks) {
  const std::vector<std::pair<std::string, std::string>> expected{
      {"euroc", "euroc"},
      {"euroc/mav0", "euroc"},
      {"euroc/mav0/cam0", "euroc"},
      {"tum", "tum"},
      {"otb", "otb"},
      {"otb-two", "otb"},
      {"vot", "vot"},
      {"vot-2013", "vot"},
      {"got10k", "got10k"},
      {"uav123/data_seq/UAV123/bike1", "uav123"},
      {"uav123/anno/UAV123/car1_2.txt", "uav123"}};
  for (const auto& [path, format] : expected) {
    const Sequence sequence = opened(kSamples / path);
    EXPECT_EQ(sequence.format, format) << path;
    EXPECT_EQ(sequence.recording.picture, (Size{32, 24})) << path;
    EXPECT_EQ(sequence.frames()->captured().size(), sequence.recording.frames()) << path;
  }
}

TEST(Formats, TakeAFolderOfPicturesForNoBenchmark) {
  const Scratch scratch;
  copy(kSamples / "otb/img", scratch, "clip");
  scratch.write("clip/timestamps.csv", "timestamp_ns\n0\n1\n2\n3\n4\n");
  scratch.write("clip/groundtruth_of_mine.csv", "x\n");
  EXPECT_EQ(opened(scratch.path() / "clip").format, "folder");
  EXPECT_EQ(opened(fs::path(RELOCK_SOURCE_DIR) / "recordings/klahaag").format, "folder");
}

TEST(Formats, SeeTheTargetWhereItIsDrawn) {
  for (const char* path : {"otb", "vot", "vot-2013", "got10k", "uav123/data_seq/UAV123/bike1"}) {
    const Recording recording = opened(kSamples / path).recording;
    ASSERT_EQ(recording.targets.size(), 1u) << path;
    EXPECT_EQ(recording.targets[0].id, "target") << path;
    for (std::size_t i = 0; i < recording.frames(); ++i) {
      const auto& outline = recording.truth_of(i, 0).outline;
      const Box expected = drawn(static_cast<int>(i));
      EXPECT_EQ(outline ? bounds(*outline) : expected, expected) << path << " frame " << i;
    }
  }
}

TEST(Formats, AreTheOneThatIsAskedFor) {
  OpenOptions options;
  options.format = "folder";
  options.rate_hz = 10;
  const Sequence sequence = open_sequence(kSamples / "got10k", options);
  EXPECT_EQ(sequence.format, "folder");
  EXPECT_TRUE(sequence.recording.targets.empty());
  EXPECT_NE(fault_of([] { opened(kSamples / "otb", "euroc"); }).find("has no mav0/cam0/data.csv"),
            std::string::npos);
  EXPECT_NE(fault_of([] { opened(kSamples / "README.md"); }).find("euroc, tum, got10k, vot, otb, uav123"),
            std::string::npos);
}

TEST(Formats, TakeTimestampsCsvBeforeAllElseAndLabelsCsvForTheirOwnLabels) {
  for (const char* name : {"otb", "vot", "vot-2013", "got10k"}) {
    const Scratch scratch;
    copy(kSamples / name, scratch, "x");
    scratch.write("x/timestamps.csv", "timestamp_ns\n5000000\n15000000\n35000000\n45000000\n55000000\n");
    scratch.write("x/labels.csv", "frame,x,y,width,height\n2,1,1,9,9\n");
    const Sequence sequence = opened(scratch.path() / "x");
    EXPECT_EQ(sequence.times_from, TimesFrom::recorded) << name;
    EXPECT_EQ(intervals_ms(sequence), (std::vector<std::int64_t>{10, 20, 10, 10})) << name;
    EXPECT_EQ(labels_of(sequence.recording), "uuvuu") << name;
  }
}

TEST(Formats, AssumeARateOnlyWhereNobodyStatesOne) {
  EXPECT_EQ(opened(kSamples / "otb").times_from, TimesFrom::assumed_rate);
  EXPECT_EQ(intervals_ms(opened(kSamples / "otb"))[2], 33);
  EXPECT_EQ(opened(kSamples / "got10k").times_from, TimesFrom::stated_rate);
  EXPECT_EQ(intervals_ms(opened(kSamples / "got10k"))[2], 100);
  EXPECT_EQ(opened(kSamples / "vot").times_from, TimesFrom::recorded);
  OpenOptions options;
  options.rate_hz = 50;
  const Sequence sequence = open_sequence(kSamples / "got10k", options);
  EXPECT_EQ(intervals_ms(sequence)[2], 20);
  EXPECT_EQ(sequence.times_from, TimesFrom::stated_rate);
}

TEST(Formats, TakeWhatRecordingTomlSaysOfATarget) {
  const Scratch scratch;
  copy(kSamples / "otb-two", scratch, "x");
  scratch.write("x/recording.toml", "sigma_px = 2\n[[target]]\nid = \"2\"\nsize_m = 0.5\nsigma_px = 0.25\n");
  const Recording recording = opened(scratch.path() / "x").recording;
  EXPECT_EQ(recording.targets[1].size_m, 0.5);
  EXPECT_EQ(recording.truth_of(0, 0).sigma_px, 2);
  EXPECT_EQ(recording.truth_of(0, 1).sigma_px, 0.25);
  scratch.write("x/recording.toml", "[[target]]\nid = \"door\"\n");
  EXPECT_NE(
      fault_of([&] { opened(scratch.path() / "x"); }).find("a target \"door\", and the labels are of 1, 2"),
      std::string::npos);
}

TEST(Formats, RefuseLabelsOfAnotherRecording) {
  const Scratch scratch;
  copy(kSamples / "otb", scratch, "x");
  scratch.write("x/groundtruth_rect.txt", "1,1,9,9\n2,1,9,9\n");
  EXPECT_NE(fault_of([&] { opened(scratch.path() / "x"); }).find("there are 2 lines for the 5 pictures of x"),
            std::string::npos);
  scratch.write("x/groundtruth_rect.txt", "900,1,9,9\n900,1,9,9\n900,1,9,9\n0,0,0,0\n900,1,9,9\n");
  EXPECT_NE(fault_of([&] { opened(scratch.path() / "x"); }).find("outside the pictures of 32x24"),
            std::string::npos);
  scratch.write("x/groundtruth_rect.txt", "1,1,9,9\n1,1,9,9\n1,one,9,9\n1,1,9,9\n1,1,9,9\n");
  EXPECT_NE(
      fault_of([&] { opened(scratch.path() / "x"); }).find("groundtruth_rect.txt:3: \"one\" is no number"),
      std::string::npos);
}

TEST(Formats, EndInAnErrorOrNotAtAllOnAnyBytes) {
  Random random(23);
  const std::string alphabet = "0123456789.,,,\n\r\t\"-=#anmNS'e \xFF";
  const std::vector<std::string> samples{"euroc", "tum",      "otb",    "otb-two",
                                         "vot",   "vot-2013", "got10k", "uav123"};
  for (const std::string& sample : samples) {
    const Scratch scratch;
    copy(kSamples / sample, scratch, "x");
    const fs::path root = scratch.path() / "x";
    const fs::path path = sample == "uav123" ? root / "anno/UAV123/car1_2.txt" : root;
    std::vector<fs::path> texts;
    for (const auto& entry : fs::recursive_directory_iterator(root))
      if (entry.is_regular_file() && entry.path().extension() != ".jpg" && entry.path().extension() != ".png")
        texts.push_back(entry.path());
    ASSERT_FALSE(texts.empty());
    std::sort(texts.begin(), texts.end());
    for (const fs::path& file : texts) {
      std::ostringstream original;
      original << std::ifstream(file, std::ios::binary).rdbuf();
      for (int i = 0; i < 100; ++i) {
        std::string text = original.str();
        for (auto n = 1 + random.below(4); n > 0 && !text.empty(); --n) {
          const auto at = random.below(text.size());
          if (random.chance(0.2))
            text.erase(at, 1 + random.below(9));
          else if (random.chance(0.2))
            text.insert(at, std::string(1 + random.below(25), alphabet[random.below(alphabet.size())]));
          else
            text[at] = alphabet[random.below(alphabet.size())];
        }
        std::ofstream(file, std::ios::binary) << text;
        fault_of([&] { opened(path); });
      }
      std::ofstream(file, std::ios::binary) << original.str();
    }
  }
}

TEST(Euroc, GivesTheCamerasOwnNanosecondsAndTheSequencesName) {
  const Sequence sequence = opened(kSamples / "euroc/mav0/cam0");
  EXPECT_EQ(sequence.recording.name, "euroc");
  EXPECT_EQ(sequence.times_from, TimesFrom::recorded);
  EXPECT_EQ(ns(sequence.recording.captured[0]), 1403636579763555584);
  EXPECT_EQ(intervals_ms(sequence), (std::vector<std::int64_t>{49, 50, 149}));
  EXPECT_TRUE(sequence.recording.targets.empty());
}

TEST(Tum, GivesDecimalSecondsToTheNanosecond) {
  EXPECT_EQ(ns(opened(kSamples / "tum").recording.captured[0]), 1305031102175304000);
  EXPECT_EQ(ns(time_of_seconds("1305031102.123456789", "f", 1)), 1305031102123456789);
  EXPECT_EQ(ns(time_of_seconds("7", "f", 1)), 7'000'000'000);
  EXPECT_EQ(ns(time_of_seconds("0.5000000000000", "f", 1)), 500'000'000);
  EXPECT_NE(fault_of([] { time_of_seconds("1.0000000001", "f", 4); }).find("f:4: the time"),
            std::string::npos);
  for (const char* text : {"", ".", "-1", "1e9", "1.5s", "99999999999", "9999999999", "nan"})
    EXPECT_FALSE(fault_of([&] { time_of_seconds(text, "f", 4); }).empty()) << text;
}

TEST(Otb, CountsPixelsFromOne) {
  const Scratch scratch;
  copy(kSamples / "otb", scratch, "x");
  scratch.write("x/groundtruth_rect.txt", "1,1,32,24\n1,1,9,9\n25,1,16,9\n31,1,16,9\n60,1,9,9\n");
  const Recording recording = opened(scratch.path() / "x").recording;
  EXPECT_EQ(*recording.truth_of(0, 0).outline, Outline(Box{-0.5, -0.5, 32, 24})) << "the whole picture";
  EXPECT_EQ(recording.truth_of(0, 0).visible_fraction, 1);
  EXPECT_EQ(labels_of(recording), "vvvua") << "half, an eighth, nothing of it in the picture";
}

TEST(Otb, HasATargetForEachLabelFileThatIsNotEmpty) {
  const Recording two = opened(kSamples / "otb-two").recording;
  ASSERT_EQ(two.targets.size(), 2u);
  EXPECT_EQ(two.targets[1].id, "2");
  EXPECT_EQ(labels_of(two, 0), "vvvvv");
  EXPECT_EQ(labels_of(two, 1), "vvavv");
  EXPECT_EQ(labels_of(opened(kSamples / "otb").recording), "vvvva");
  const Scratch scratch;
  copy(kSamples / "otb-two", scratch, "x");
  scratch.write("x/groundtruth_rect.1.txt", "\n");
  EXPECT_EQ(opened(scratch.path() / "x").recording.targets[0].id, "target");
}

TEST(Otb, KnowsWhereThePublishedLabelsOfDavidBegin) {
  const Scratch scratch;
  fs::create_directories(scratch.path() / "David/img");
  for (int i = 1; i <= 770; ++i)
    fs::create_symlink(kSamples / "otb/img/0001.jpg", scratch.path() / fmt::format("David/img/{:04}.jpg", i));
  std::string lines;
  for (int i = 0; i < 471; ++i) lines += "5,7,10,8\n";
  scratch.write("David/groundtruth_rect.txt", lines);
  const std::string labels = labels_of(opened(scratch.path() / "David").recording);
  EXPECT_EQ(labels, std::string(299, 'u') + std::string(471, 'v'));
}

TEST(Vot, ReadsBoxesPolygonsAndMasksAsTheSamePlace) {
  const auto region = [](const std::string& line) { return vot_region(line, "f", 1); };
  EXPECT_EQ(region("10,6,10,8"), Outline(Box{9.5, 5.5, 10, 8}));
  EXPECT_EQ(region("m10,6,10,8,0,80"), Outline(Box{9.5, 5.5, 10, 8}));
  EXPECT_EQ(region("m8,5,4,3,5,2,2,2,1"), Outline(Box{8.5, 5.5, 2, 2})) << "smaller than the mask's frame";
  const Quad clockwise{{Vec2{9.5, 5.5}, {19.5, 5.5}, {19.5, 13.5}, {9.5, 13.5}}};
  EXPECT_EQ(region("10,6,20,6,20,14,10,14"), Outline(clockwise));
  EXPECT_EQ(region("10,6,10,14,20,14,20,6"), Outline(clockwise)) << "the other way round";
  EXPECT_EQ(region("10,6,20,14,20,6,10,14"), Outline(Box{9.5, 5.5, 10, 8})) << "crosses itself";
  EXPECT_EQ(region("10,6,20,7,15,14"), Outline(Box{9.5, 5.5, 10, 8})) << "three points";
  for (const char* absent : {"nan,nan,nan,nan", "0", "0,0,0,0", "m0,0,0,0,0", "m3,3,2,2,4"})
    EXPECT_FALSE(region(absent)) << absent;
  for (const char* wrong :
       {"", "7", "3,4", "nan,1,2", "1,2,3,4,5", "1,2,-3,4", "m1,2,3", "m0,0,2,2,0,5", "m0,0,2,x", "box"})
    EXPECT_NE(fault_of([&] { region(wrong); }).find("f:1: "), std::string::npos) << wrong;
}

TEST(Vot, GivesItsTimestampsAndKeepsStartsFromTaggedFrames) {
  const Sequence sequence = opened(kSamples / "vot");
  EXPECT_EQ(ns(sequence.recording.captured[0]), 12'000'000'000);
  EXPECT_EQ(intervals_ms(sequence), (std::vector<std::int64_t>{33, 33, 100, 33}));
  EXPECT_EQ(labels_of(sequence.recording), "vvvva");
  EXPECT_EQ(sequence.recording.truth_of(2, 0).occluded_fraction, 0.1);
  EXPECT_EQ(sequence.recording.truth_of(1, 0).occluded_fraction, 0);
}

TEST(Vot, WithoutTimestampsHasTheRateThatTheSequenceStates) {
  const Scratch scratch;
  copy(kSamples / "vot", scratch, "x");
  fs::remove(scratch.path() / "x/timestamp.value");
  scratch.write("x/sequence", "channels.color=color/%08d.jpg\nfps=25\nlength=4\n");
  scratch.write("x/groundtruth.txt", "4,6,10,8\n");
  scratch.write("x/occlusion.tag", "0\n0\n0\n0\n");
  const Sequence sequence = opened(scratch.path() / "x");
  EXPECT_EQ(sequence.times_from, TimesFrom::stated_rate);
  EXPECT_EQ(intervals_ms(sequence), (std::vector<std::int64_t>{40, 40, 40}));
  EXPECT_EQ(labels_of(sequence.recording), "vuuu") << "only the start is published";
  scratch.write("x/sequence", "channels.color=" + std::string(9000, 'c') + "/%08d.jpg\n");
  EXPECT_NE(fault_of([&] { opened(scratch.path() / "x"); }).find("there is no such folder"),
            std::string::npos);
  scratch.write("x/sequence", "fps=fast\n");
  EXPECT_NE(fault_of([&] { opened(scratch.path() / "x"); }).find("sequence:1: fps is \"fast\""),
            std::string::npos);
}

TEST(Vot, HasATargetForEachGroundtruthFile) {
  const Scratch scratch;
  copy(kSamples / "vot", scratch, "x");
  fs::rename(scratch.path() / "x/groundtruth.txt", scratch.path() / "x/groundtruth_cat.txt");
  scratch.write("x/groundtruth_dog.txt", "1,1,9,9\n");
  const Recording recording = opened(scratch.path() / "x").recording;
  ASSERT_EQ(recording.targets.size(), 2u);
  EXPECT_EQ(recording.targets[0].id, "cat");
  EXPECT_EQ(labels_of(recording, 1), "vuuuu");
}

TEST(Got10k, LabelsByWhatIsVisibleOfTheTarget) {
  const Recording recording = opened(kSamples / "got10k").recording;
  EXPECT_EQ(labels_of(recording), "vvuua") << "8, 6, 3, 0 eighths, and absent";
  EXPECT_EQ(recording.truth_of(1, 0).visible_fraction, 0.75);
  EXPECT_EQ(recording.truth_of(1, 0).occluded_fraction, 0.25);
}

TEST(Got10k, OfTheTestSetHasItsStart) {
  const Scratch scratch;
  copy(kSamples / "got10k", scratch, "GOT-10k_Test_000001");
  const fs::path path = scratch.path() / "GOT-10k_Test_000001";
  for (const char* file : {"absence.label", "cover.label", "cut_by_image.label", "meta_info.ini"})
    fs::remove(path / file);
  scratch.write("GOT-10k_Test_000001/groundtruth.txt", "5,7,10,8\n");
  const Sequence sequence = opened(path);
  EXPECT_EQ(sequence.format, "got10k");
  EXPECT_EQ(sequence.times_from, TimesFrom::assumed_rate);
  EXPECT_EQ(labels_of(sequence.recording), "vuuuu");
}

TEST(Uav123, OpensAPieceOfALongRecordingByItsAnnotation) {
  const Recording second = opened(kSamples / "uav123/anno/UAV123/car1_2.txt").recording;
  EXPECT_EQ(second.name, "car1_2");
  EXPECT_EQ(labels_of(second), "vvv");
  EXPECT_EQ(bounds(*second.truth_of(0, 0).outline), drawn(2)) << "it begins at the third picture";
  EXPECT_NE(fault_of([] { opened(kSamples / "uav123/data_seq/UAV123/car1"); }).find("open one of them"),
            std::string::npos);
  EXPECT_EQ(labels_of(opened(kSamples / "uav123/data_seq/UAV123/bike1").recording), "vvavv");
}

TEST(Uav123, CutsTheTimesOfAPieceOutOfThoseOfTheFolder) {
  const Scratch scratch;
  copy(kSamples / "uav123", scratch, "x");
  scratch.write("x/data_seq/UAV123/car1/timestamps.csv", "timestamp_ns\n0\n1\n2\n3\n9\n");
  const auto captured = opened(scratch.path() / "x/anno/UAV123/car1_2.txt").recording.captured;
  EXPECT_EQ(captured, (std::vector<Time>{time_ns(2), time_ns(3), time_ns(9)}));
  fs::remove(scratch.path() / "x/configSeqs.m");
  EXPECT_NE(fault_of([&] { opened(scratch.path() / "x/anno/UAV123/car1_2.txt"); }).find("is a piece of"),
            std::string::npos);
}

TEST(Uav123, TakesFlatCopies) {
  for (const char* annotation : {"bike1.txt", "bike1/bike1.txt"}) {
    const Scratch scratch;
    copy(kSamples / "uav123/data_seq/UAV123/bike1", scratch, "bike1");
    fs::copy(kSamples / "uav123/anno/UAV123/bike1.txt", scratch.path() / annotation);
    const Sequence sequence = opened(scratch.path() / "bike1");
    EXPECT_EQ(sequence.format, "uav123");
    EXPECT_EQ(labels_of(sequence.recording), "vvavv");
  }
}

}  // namespace
}  // namespace relock
