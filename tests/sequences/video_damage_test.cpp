#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "sequences/open.h"
#include "tests/sequences/movies.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

class DamagedVideo : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_ffmpeg()) GTEST_SKIP() << "the program ffmpeg is missing; install package ffmpeg";
  }
  std::string file(const std::string& name) const { return (scratch.path() / name).string(); }
  std::string content(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// A film with enough in it that a cut or a blow hits data and not a header.
  void film(const std::string& name, const std::string& coding) const {
    ffmpeg("-f lavfi -i testsrc2=size=320x240:rate=30:duration=2 " + coding + " " + file(name));
  }
  /// Keeps this part of a file.
  void cut(const std::string& name, double part) const {
    std::filesystem::resize_file(
        file(name),
        static_cast<std::uintmax_t>(part * static_cast<double>(std::filesystem::file_size(file(name)))));
  }

  struct Shown {
    int frames = 0;     ///< pictures before the first fault
    std::string fault;  ///< empty if none
  };
  /// All pictures up to the first fault, each compared with that of the undamaged film.
  Shown show(const std::string& name, const std::string& whole, const OpenOptions& options = {}) const {
    const Sequence sequence = open_sequence(file(name), options);
    const auto frames = sequence.frames(), undamaged = open_sequence(file(whole), options).frames();
    Shown shown;
    try {
      for (; frames->next(); ++shown.frames) {
        const Image image = frames->image();
        undamaged->next();
        const Image expected = undamaged->image();
        for (int y = 0; y < image.size().height; ++y)
          EXPECT_TRUE(std::equal(image.row(y), image.row(y) + 3 * image.size().width, expected.row(y)))
              << name << ": frame " << shown.frames << ", row " << y;
      }
    } catch (const Error& fault) {
      shown.fault = fault.what();
    }
    return shown;
  }
  const Scratch scratch;
};

TEST_F(DamagedVideo, ShowsTheFramesBeforeItIsCutOffAndNamesTheOneWhereItIs) {
  for (const auto& [name, coding] :
       std::vector<std::pair<std::string, std::string>>{{"a.mp4", "-c:v libx264 -bf 2 -movflags +faststart"},
                                                        {"a.mkv", "-c:v libx264 -bf 2"},
                                                        {"a.ts", "-c:v libx264 -bf 2"},
                                                        {"m.mkv", "-c:v mjpeg -pix_fmt yuvj420p"},
                                                        {"m.avi", "-c:v mjpeg -pix_fmt yuvj420p"}}) {
    SCOPED_TRACE(name);
    film(name, coding);
    std::filesystem::copy(file(name), file("whole-" + name));
    cut(name, 0.7);
    if (name == "a.mkv" || name == "m.mkv") cut(name, 0.6);  // only a second or more is missed there
    const Shown shown = show(name, "whole-" + name);
    EXPECT_GT(shown.frames, 15);
    EXPECT_LT(shown.frames, 55);
    EXPECT_NE(shown.fault.find(fmt::format("{}: frame {} at ", file(name), shown.frames)), std::string::npos)
        << shown.fault;
  }
}

TEST_F(DamagedVideo, NeverShowsAFrameThatIsMadeFromDamagedOnes) {
  for (const auto& [name, coding] : std::vector<std::pair<std::string, std::string>>{
           {"a.mp4", "-c:v libx264 -bf 2 -g 20 -movflags +faststart"},
           {"a.ts", "-c:v libx264 -bf 2 -g 20"}}) {
    SCOPED_TRACE(name);
    film(name, coding);
    std::filesystem::copy(file(name), file("whole-" + name));
    std::fstream bytes(file(name), std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file(name)) / 2));
    for (int i = 0; i < 400; ++i) bytes.put(static_cast<char>(i * 37 + 11));
    bytes.close();
    const Sequence sequence = open_sequence(file(name));
    const auto frames = sequence.frames(), undamaged = open_sequence(file("whole-" + name)).frames();
    int faults = 0, last_fault = -1;
    while (const auto stamp = frames->next()) {
      while (undamaged->next()->captured < stamp->captured) continue;  // a frame may be lost without a trace
      try {
        const Image image = frames->image(), expected = undamaged->image();
        for (int y = 0; y < image.size().height; ++y)
          EXPECT_TRUE(std::equal(image.row(y), image.row(y) + 3 * image.size().width, expected.row(y)))
              << "frame " << stamp->index;
      } catch (const Error&) {
        ++faults;
        last_fault = static_cast<int>(stamp->index);
      }
    }
    EXPECT_GT(faults, 0);
    EXPECT_LT(last_fault, 59) << "a key frame starts afresh";
  }
}

TEST_F(DamagedVideo, BeginsAtTheFirstFrameThatCanBeDecoded) {
  ffmpeg(barred(90) + "-c:v libx264 -bf 2 -g 30 -copyts -muxdelay 0 -muxpreload 0 " + file("whole.ts"));
  const std::string bytes = content("whole.ts");
  scratch.write("joined.ts", bytes.substr(188 * (bytes.size() / 188 / 8)));
  const Sequence sequence = open_sequence(file("joined.ts"));
  const auto slots = slots_of_pictures(*sequence.frames());
  EXPECT_GT(slots.front(), 0);
  EXPECT_EQ(slots.back(), 89);
  EXPECT_EQ(slots_of_times(sequence.recording.captured, slots.front()), slots);
}

TEST_F(DamagedVideo, IsToldInOneSentence) {
  const auto fault = [&](const std::string& name) { return fault_of([&] { open_sequence(file(name)); }); };
  scratch.write("empty.mp4", "");
  EXPECT_NE(fault("empty.mp4").find("empty.mp4 is empty"), std::string::npos);
  scratch.write("text.mp4", "this is no video, whatever it is called\n");
  EXPECT_NE(fault("text.mp4").find("text.mp4 is no video that can be read"), std::string::npos);
  ffmpeg("-f lavfi -i sine=duration=1 -c:a aac " + file("sound.mp4"));
  EXPECT_NE(fault("sound.mp4").find("sound.mp4 holds no stream of pictures"), std::string::npos);
  film("late.mp4", "-c:v libx264");  // its index is at its end
  cut("late.mp4", 0.9);
  EXPECT_NE(fault("late.mp4").find("index is missing"), std::string::npos);
}

TEST_F(DamagedVideo, WithACodingThatNobodyKnowsIsTold) {
  film("a.avi", "-c:v mjpeg -pix_fmt yuvj420p");
  std::string bytes = content("a.avi");
  for (std::size_t at = 0; (at = bytes.find("MJPG", at)) != std::string::npos;) bytes.replace(at, 4, "QXZ1");
  scratch.write("unknown.avi", bytes);
  EXPECT_NE(fault_of([&] {
              open_sequence(file("unknown.avi"));
            }).find("the installed libav cannot decode its pictures (an unknown coding)"),
            std::string::npos);
}

TEST_F(DamagedVideo, WithTimesThatGoBackIsRefusedUnlessASidecarHasBetterOnes) {
  ffmpeg(barred(10) + "-c:v libx264 -bf 0 -mpegts_flags +initial_discontinuity " + file("one.ts"));
  scratch.write("twice.ts", content("one.ts") + content("one.ts"));
  const std::string fault = fault_of([&] { open_sequence(file("twice.ts")); });
  EXPECT_NE(fault.find("has frame 10 at "), std::string::npos) << fault;
  EXPECT_NE(fault.find("goes back behind the one before it"), std::string::npos) << fault;
  std::string times = "timestamp_ns\n";
  for (int i = 0; i < 20; ++i) times += fmt::format("{}\n", i);
  scratch.write("twice.timestamps.csv", times);
  EXPECT_EQ(slots_of_pictures(*open_sequence(file("twice.ts")).frames()),
            (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST_F(DamagedVideo, OfPicturesThatChangeTheirSizeNamesTheFirstOfAnother) {
  ffmpeg(barred(5) + "-c:v libx264 -bf 0 " + file("one.ts"));
  ffmpeg(barred(5, "96x64") +
         "-c:v libx264 -bf 0 -output_ts_offset 10 -mpegts_flags +initial_discontinuity " + file("two.ts"));
  scratch.write("both.ts", content("one.ts") + content("two.ts"));
  const auto frames = open_sequence(file("both.ts")).frames();
  const std::string fault = fault_of([&] { slots_of_pictures(*frames); });
  EXPECT_NE(fault.find("frame 5 at "), std::string::npos) << fault;
  EXPECT_NE(fault.find("this picture is 96x64 and those before it 64x48"), std::string::npos) << fault;
}

}  // namespace
}  // namespace relock
