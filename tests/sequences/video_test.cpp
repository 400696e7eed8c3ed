#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/opencv.h"
#include "sequences/open.h"
#include "tests/sequences/movies.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

class Video : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_ffmpeg()) GTEST_SKIP() << "the program ffmpeg is missing; install package ffmpeg";
  }
  std::string file(const std::string& name) const { return (scratch.path() / name).string(); }
  Sequence open(const std::string& name, const OpenOptions& options = {}) const {
    return open_sequence(file(name), options);
  }
  std::string fault(const std::string& name) const {
    return fault_of([&] { open(name); });
  }
  const Scratch scratch;
};

using VideoReader = Video;

TEST_F(VideoReader, GivesTheContainersOwnTimesWhenFramesAreMissing) {
  // With and without frames that are stored out of order, in containers that count time in different units.
  for (const auto& [name, coding] : std::vector<std::pair<std::string, std::string>>{
           {"b.mp4", "-c:v libx264 -bf 2"},
           {"b.mkv", "-c:v libx264 -bf 2"},
           {"b.mov", "-c:v libx264 -bf 3 -pix_fmt yuv420p"},
           {"b.ts", "-c:v libx264 -bf 2 -copyts -muxdelay 0 -muxpreload 0"},
           {"plain.mp4", "-c:v libx264 -bf 0"},
           {"v.webm", "-c:v libvpx -b:v 1M"},
           {"m.mkv", "-c:v mjpeg -q:v 2 -pix_fmt yuvj420p"}}) {
    SCOPED_TRACE(name);
    ffmpeg(barred(120) + kGaps + coding + " " + file(name));
    const Sequence sequence = open(name);
    EXPECT_EQ(sequence.format, "video");
    EXPECT_EQ(sequence.times_from, TimesFrom::recorded);
    EXPECT_EQ(slots_of_times(sequence.recording.captured, 1), slots_left(120));
    EXPECT_EQ(slots_of_pictures(*sequence.frames()), slots_left(120));
    EXPECT_NEAR(static_cast<double>(sequence.recording.period.count()), 1e9 / 30, 0.6e6)
        << "mkv counts in ms";
  }
}

TEST_F(VideoReader, CountsTheEmptyFramesOfAnAviAsGaps) {
  ffmpeg(barred(120) + kGaps + "-c:v mjpeg -pix_fmt yuvj420p " + file("a.avi"));
  const Sequence sequence = open("a.avi");
  auto times = slots_of_times(sequence.recording.captured, 0), slots = slots_left(120);
  EXPECT_EQ(slots_of_pictures(*sequence.frames()), slots);
  times.front() = slots.front();  // the format has no place for an empty frame before the first
  EXPECT_EQ(times, slots);
}

TEST_F(VideoReader, KeepsTimesToTheNanosecondAndTheEpochOfTheContainer) {
  ffmpeg(barred(120) + kGaps + "-c:v libx264 " + file("a.mp4"));
  const auto captured = open("a.mp4").recording.captured;
  const auto slots = slots_left(120);
  ASSERT_EQ(captured.size(), slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i)
    EXPECT_NEAR(static_cast<double>((captured[i] - captured[0]).count()), (slots[i] - slots[0]) / 30.0 * 1e9,
                1);
  EXPECT_NEAR(seconds(captured[0]), 1 / 30.0, 1e-3) << "slot 1, not 0; an edit list counts in ms";
}

TEST_F(VideoReader, ShowsTheSameFramesWhenSomeAreNotLookedAt) {
  ffmpeg(barred(120) + kGaps + "-c:v libx264 -bf 2 " + file("a.mp4"));
  const Sequence sequence = open("a.mp4");
  const auto frames = sequence.frames();
  const auto slots = slots_left(120);
  while (const auto stamp = frames->next())
    if (stamp->index % 3 == 2) {
      EXPECT_EQ(slot_shown(frames->image()), slots[static_cast<std::size_t>(stamp->index)]);
      EXPECT_EQ(slot_shown(frames->image()), slots[static_cast<std::size_t>(stamp->index)]) << "asked again";
    }
}

TEST_F(VideoReader, TakesTheTimesOfASidecarBeforeTheContainers) {
  ffmpeg(barred(4) + "-c:v libx264 " + file("a.mp4"));
  scratch.write("a.timestamps.csv", "timestamp_ns\n1000\n2000\n3000\n9000\n");
  EXPECT_EQ(ns(open("a.mp4").recording.captured[3]), 9000);
  EXPECT_EQ(slots_of_pictures(*open("a.mp4").frames()), (std::vector<int>{0, 1, 2, 3}));
  scratch.write("a.timestamps.csv", "timestamp_ns\n1000\n2000\n3000\n");
  EXPECT_NE(fault("a.mp4").find("a.timestamps.csv: there are 3 times for the 4 frames of"),
            std::string::npos);
}

TEST_F(VideoReader, AsksForTimesWhereTheFileKeepsNone) {
  for (const char* name : {"a.h264", "b.avi", "m.mjpeg"}) {
    SCOPED_TRACE(name);
    ffmpeg(barred(20) + (name[0] == 'm' ? "-c:v mjpeg -pix_fmt yuvj420p " : "-c:v libx264 -bf 2 ") +
           file(name));
    EXPECT_NE(fault(name).find("or --rate"), std::string::npos) << fault(name);
    OpenOptions options;
    options.rate_hz = 30;
    const Sequence sequence = open(name, options);
    EXPECT_EQ(sequence.times_from, TimesFrom::stated_rate);
    EXPECT_EQ(ns(sequence.recording.captured[3]), 100'000'000);
    EXPECT_EQ(slots_of_pictures(*sequence.frames()), slots_of_times(sequence.recording.captured, 0));
    std::string times = "timestamp_ns\n";
    for (int i = 0; i < 20; ++i) times += fmt::format("{}\n", 10 * i);
    scratch.write(std::filesystem::path(name).stem().string() + ".timestamps.csv", times);
    EXPECT_EQ(open(name).times_from, TimesFrom::recorded);
  }
}

TEST_F(VideoReader, CountsNoFrameThatAnEditListCutsOut) {
  ffmpeg(barred(90) + "-c:v libx264 -bf 2 -g 30 " + file("whole.mp4"));
  ffmpeg("-ss 1.5 -i " + file("whole.mp4") + " -c copy " + file("cut.mp4"));
  const Sequence sequence = open("cut.mp4");
  const auto slots = slots_of_pictures(*sequence.frames());
  ASSERT_EQ(slots.size(), sequence.recording.frames());
  EXPECT_EQ(slots.front(), 45) << "the packets begin with the key frame, slot 30";
  EXPECT_EQ(slots.back(), 89);
  EXPECT_GE(ns(sequence.recording.captured.front()), 0);
}

TEST_F(VideoReader, TurnsAPictureUprightAsAPlayerDoes) {
  // Left half dark, right half bright; stored as 64x48.
  ffmpeg(
      "-f lavfi -i \"color=black:size=64x48:rate=30:duration=0.1,format=gray,geq=lum='if(lt(X,32),40,200)'\" "
      "-c:v libx264 " +
      file("stored.mp4"));
  const auto level = [](const Image& image, int x, int y) {
    return int{image.row(y)[channels(image.format()) * x]};
  };
  const auto turned_by = [&](const std::string& angle) {
    const std::string name = "turned" + angle + ".mp4";
    // An option of the input since ffmpeg 6, a tag of the output before.
    if (std::system(fmt::format("ffmpeg -v quiet -y -display_rotation {} -i {} -c copy {}", angle,
                                file("stored.mp4"), file(name))
                        .c_str()) != 0)
      ffmpeg(
          fmt::format("-i {} -c copy -metadata:s:v:0 rotate={} {}", file("stored.mp4"), angle, file(name)));
    return name;
  };
  const Sequence quarter = open(turned_by("90"));
  EXPECT_EQ(quarter.recording.picture.width, 48);
  EXPECT_EQ(quarter.recording.picture.height, 64);
  // What a player shows is what ffmpeg makes of it when it decodes.
  ffmpeg("-i " + file("turned90.mp4") + " -frames:v 1 -update 1 " + file("shown.png"));
  const auto frames = quarter.frames();
  frames->next();
  const Image image = frames->image();
  scratch.write("shown/recording.toml", "rate_hz = 30\n");
  std::filesystem::rename(file("shown.png"), file("shown/1.png"));
  const auto shown = open("shown").frames();
  shown->next();
  for (const int y : {10, 50}) EXPECT_NEAR(level(image, 24, y), level(shown->image(), 24, y), 4);
  EXPECT_GT(std::abs(level(image, 24, 10) - level(image, 24, 50)), 100);

  const auto half = open(turned_by("180")).frames();
  half->next();
  EXPECT_EQ(half->picture_size().width, 64);
  EXPECT_GT(level(half->image(), 10, 24), level(half->image(), 50, 24));
}

TEST_F(VideoReader, HonoursTheRangeAndMatrixOfColours) {
  // Four colours through three codings of them come out as they went in.
  for (const char* coding :
       {"-vf scale=out_color_matrix=bt709:out_range=tv,format=yuv444p -colorspace bt709 -color_range tv",
        "-vf scale=out_color_matrix=bt601:out_range=pc,format=yuv444p -colorspace smpte170m -color_range pc",
        "-vf scale=out_color_matrix=bt601:out_range=tv,format=yuv444p"}) {
    SCOPED_TRACE(coding);
    ffmpeg(fmt::format("-f lavfi -i color=0x20C0E0:size=64x48:rate=30:duration=0.1 {} -c:v libx264 -qp 1 {}",
                       coding, file("a.mkv")));
    const auto frames = open("a.mkv").frames();
    frames->next();
    const std::uint8_t* blue_green_red = frames->image().row(24) + 3 * 32;
    EXPECT_NEAR(blue_green_red[0], 0xE0, 3);
    EXPECT_NEAR(blue_green_red[1], 0xC0, 3);
    EXPECT_NEAR(blue_green_red[2], 0x20, 3);
  }
}

TEST_F(VideoReader, KeepsAGreyVideoGreyAndOddSizesOdd) {
  ffmpeg(barred(6, "65x47") + "-c:v ffv1 -pix_fmt gray " + file("a.mkv"));
  const Sequence sequence = open("a.mkv");
  const auto frames = sequence.frames();
  frames->next();
  EXPECT_EQ(frames->image().format(), PixelFormat::gray8);
  EXPECT_EQ(frames->image().size().width, 65);
  EXPECT_EQ(frames->image().size().height, 47);
  EXPECT_EQ(slots_of_pictures(*sequence.frames()), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  ffmpeg(barred(6, "65x47") + "-c:v ffv1 -pix_fmt yuv444p " + file("b.mkv"));
  EXPECT_EQ(slots_of_pictures(*open("b.mkv").frames()), (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

TEST_F(VideoReader, TakesThePicturesOfAFileWithSoundAndOtherStreams) {
  ffmpeg("-f lavfi -i color=black:size=640x480:rate=25:duration=2 -f lavfi -i sine=duration=9 " + barred(30) +
         "-map 0 -map 1 -map 2 -c:v libx264 -disposition:v:0 0 -disposition:v:1 default " + file("a.mkv"));
  const Sequence sequence = open("a.mkv");
  EXPECT_EQ(sequence.recording.picture.width, 64) << "the default stream, not the larger one";
  EXPECT_EQ(sequence.recording.frames(), 30u);
}

TEST_F(VideoReader, ReadsAFolderThatHoldsOneVideoAndNoPictures) {
  std::filesystem::create_directories(scratch.path() / "flight");
  ffmpeg(barred(10) + "-c:v libx264 " + file("flight/camera.mp4"));
  scratch.write("flight/labels.csv", "frame,x,y,width,height\n0,1,1,9,9\n");
  EXPECT_EQ(open("flight").recording.name, "flight");
  EXPECT_EQ(open("flight").recording.targets.size(), 1u);
  EXPECT_EQ(open("flight/camera.mp4").recording.name, "camera");
  EXPECT_EQ(open("flight/camera.mp4").recording.targets.size(), 0u) << "its labels are camera.labels.csv";
  scratch.write("flight/camera.labels.csv", "frame,x,y,width,height\n0,1,1,9,9\n");
  scratch.write("flight/camera.toml", "name = \"seven\"\n");
  EXPECT_EQ(open("flight/camera.mp4").recording.targets.size(), 1u);
  EXPECT_EQ(open("flight/camera.mp4").recording.name, "seven");

  std::filesystem::copy(file("flight/camera.mp4"), file("flight/second.mkv"));
  EXPECT_NE(fault("flight").find("holds 2 videos"), std::string::npos);
  scratch.write("flight/img/0001.jpg", "a picture below it");
  EXPECT_NE(open_sequence(file("flight/camera.mp4")).format, "folder");
  EXPECT_EQ(fault("flight").find("videos"), std::string::npos) << "a folder of pictures with a film of them";
}

}  // namespace
}  // namespace relock
