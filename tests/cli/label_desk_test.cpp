#include "cli/labelling/desk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "cli/files.h"
#include "cli/labelling/check_sheet.h"
#include "cli/labelling/likeness.h"
#include "cli/labelling/shelf.h"
#include "core/opencv.h"
#include "source_folder.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

class Desk : public testing::Test {
 protected:
  Desk() {
    scratch_.write_pictures(30);
    scratch_.write("recording.toml", "rate_hz = 10\n");
  }
  fs::path file(const char* name) const { return scratch_.path() / name; }
  LabelDesk open() const {
    OpenOptions options;
    options.truth = Truth::ignored;
    return LabelDesk(open_sequence(scratch_.path(), options), {});
  }
  static Json box(std::size_t frame, double x) {
    return {
        {"do", "key"}, {"target", "target"}, {"frame", frame}, {"state", "placed"}, {"box", {x, 10, 12, 10}}};
  }
  static Json state(std::size_t frame, const char* what) {
    return {{"do", "key"}, {"target", "target"}, {"frame", frame}, {"state", what}};
  }
  Scratch scratch_;
};

TEST_F(Desk, WritesNothingBeforeAnythingIsDone) {
  open();
  EXPECT_FALSE(fs::exists(file("labels.csv")));
  EXPECT_FALSE(fs::exists(file("labels.keys.json")));
}

TEST_F(Desk, HasEverythingOnDiskWhenAnEditReturns) {
  LabelDesk desk = open();
  for (const std::size_t frame : {0, 10, 20}) {
    desk.edit(box(frame, 5 + static_cast<double>(frame)));
    const LabelDesk again = open();
    EXPECT_EQ(again.document().targets, desk.document().targets);
  }
  const Recording recording = open_sequence(scratch_.path()).recording;
  EXPECT_EQ(to_string(recording.truth_of(10, 0).source), "hand");
  EXPECT_EQ(to_string(recording.truth_of(5, 0).source), "spline");
  EXPECT_NEAR(centre_of(*recording.truth_of(5, 0).outline).x, 5 + 5 + 6, 1e-3);
  EXPECT_EQ(recording.truth_of(25, 0).label, Label::unlabelled);
}

TEST_F(Desk, UndoesWhateverWasDone) {
  LabelDesk desk = open();
  std::vector<std::string> texts;
  const std::vector<Json> edits{box(0, 5),
                                box(10, 9),
                                state(15, "absent"),
                                box(10, 11),
                                {{"do", "target"}, {"id", "b"}},
                                {{"do", "take"}, {"target", "target"}, {"frame", 0}}};
  for (const Json& edit : edits) {
    texts.push_back(Json(desk.state({})["targets"]).dump());
    desk.edit(edit);
  }
  for (std::size_t i = texts.size(); i-- > 0;) {
    desk.edit({{"do", "undo"}});
    EXPECT_EQ(Json(desk.state({})["targets"]).dump(), texts[i]);
  }
  EXPECT_EQ(fault_of([&] { desk.edit({{"do", "undo"}}); }), "there is nothing to undo");
}

TEST_F(Desk, ChangesNothingByAnEditThatCannotBeDone) {
  LabelDesk desk = open();
  desk.edit(box(0, 5));
  const std::string keys = read_file(file("labels.keys.json")), labels = read_file(file("labels.csv"));
  for (const Json& edit :
       {box(30, 5), box(3, 500), Json{{"do", "key"}, {"target", "nobody"}, {"frame", 1}, {"state", "absent"}},
        Json{{"do", "take"}, {"target", "target"}, {"frame", 7}}, Json{{"do", "dance"}}, state(3, "placed"),
        Json{{"do", "target"}, {"id", "target"}}, Json{{"do", "target"}, {"id", "a\nb"}}})
    EXPECT_NE(fault_of([&] { desk.edit(edit); }), "") << edit.dump();
  EXPECT_EQ(read_file(file("labels.keys.json")), keys);
  EXPECT_EQ(read_file(file("labels.csv")), labels);
}

TEST_F(Desk, MakesLabelsAgainThatAKillLeftAStepBehind) {
  LabelDesk desk = open();
  desk.edit(box(0, 5));
  const std::string before = read_file(file("labels.csv"));
  desk.edit(box(10, 9));
  const std::string after = read_file(file("labels.csv"));
  write_file(file("labels.csv"), before);  // killed between the two files
  open();
  EXPECT_EQ(read_file(file("labels.csv")), after);
  fs::remove(file("labels.csv"));
  open();
  EXPECT_EQ(read_file(file("labels.csv")), after);
}

TEST_F(Desk, KnowsItsRecordingByItsPicturesWhereverItIs) {
  LabelDesk desk = open();
  desk.edit(box(0, 5));
  const std::string text = read_file(file("labels.keys.json"));
  const fs::path moved = scratch_.path() / "moved";
  fs::create_directory(moved);
  for (const char* name : {"images", "recording.toml", "labels.csv", "labels.keys.json"})
    fs::rename(file(name), moved / name);
  OpenOptions options;
  options.truth = Truth::ignored;
  EXPECT_EQ(LabelDesk(open_sequence(moved, options), {}).document().targets, desk.document().targets);
  fs::copy_file(moved / "images/3.png", moved / "images/4.png", fs::copy_options::overwrite_existing);
  const std::string fault = fault_of([&] { LabelDesk(open_sequence(moved, options), {}); });
  EXPECT_NE(fault.find("was made for another recording"), std::string::npos) << fault;
  EXPECT_EQ(read_file(moved / "labels.keys.json"), text);
}

TEST_F(Desk, RefusesToWriteOverWhatSomebodyElseSavedMeanwhile) {
  LabelDesk mine = open(), other = open();
  other.edit(box(0, 5));
  EXPECT_NE(fault_of([&] { mine.edit(box(3, 5)); }).find("changed by somebody else"), std::string::npos);
  EXPECT_EQ(open().document().targets, other.document().targets);
}

TEST_F(Desk, SurvivesAnyBytesInItsFileWithOneSentence) {
  LabelDesk desk = open();
  desk.edit(box(0, 5));
  desk.edit(state(7, "absent"));
  const std::string text = read_file(file("labels.keys.json"));
  for (std::size_t cut = 0; cut < text.size(); cut += 7) {
    write_file(file("labels.keys.json"), text.substr(0, cut));
    const std::string fault = fault_of([&] { open(); });
    EXPECT_NE(fault, "") << cut;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
}

TEST(KeyFile, HasTheSameKeyFramesAfterWritingAndReading) {
  const KeyedRecording recording{"flight", 100, {640, 360}, "9f"};
  KeyDocument document{recording, 1.5, {"a", "b"}, {{"door \"1\"", {}}, {"b", {}}}};
  put_key(document.targets[0],
          {3, KeyState::placed, Ellipse{{50, 60}, 20, 9, 2.5}, 0.25, {LabelSource::Kind::hand}});
  put_key(document.targets[0], {9, KeyState::absent, {}, 1, {LabelSource::Kind::hand}});
  put_key(document.targets[1], {5, KeyState::occluded, Quad{{Vec2{1, 2}, {9, 2}, {9, 8}, {1, 8}}}, 2,
                                parse_label_source("detector ring")});
  const KeyDocument back = parse_keys(to_json_text(document), "k.json", recording);
  ASSERT_EQ(back.targets.size(), 2u);
  EXPECT_EQ(back.targets[1], document.targets[1]);
  EXPECT_EQ(back.targets[0].keys[1], document.targets[0].keys[1]);
  EXPECT_NEAR(std::get<Ellipse>(*back.targets[0].keys[0].outline).angle_rad, 2.5, 1e-9);
  EXPECT_EQ(back.max_gap_s, 1.5);
  EXPECT_EQ(back.labels, document.labels);
}

TEST_F(Desk, ShowsEveryPictureInWhateverOrderItIsAskedFor) {
  const LabelDesk desk = open();
  PictureShelf shelf(desk.sequence().frames);
  for (const std::size_t frame : {0, 29, 28, 3, 4, 5, 27, 0, 12})
    EXPECT_EQ(shelf.picture(frame).at<std::uint8_t>(5, 5), 10 + frame) << frame;
  EXPECT_NE(fault_of([&] { shelf.picture(30); }), "");
}

TEST(Likeness, IsOneForTheSameLookAtAnyBrightness) {
  cv::Mat picture(60, 80, CV_8UC1);
  cv::randu(picture, 0, 100);
  cv::Mat brighter = 2 * picture + 20, other(60, 80, CV_8UC1);
  cv::randu(other, 0, 255);
  const Outline outline = Box{10, 12, 24, 20};
  const cv::Mat look = look_at(view(picture), outline);
  EXPECT_NEAR(correlation(look, look_at(view(brighter), outline)), 1, 1e-3);
  EXPECT_LT(correlation(look, look_at(view(other), outline)), 0.5);
  EXPECT_EQ(correlation(look, cv::Mat::ones(look.size(), look.type())), 0);
}

TEST_F(Desk, IsCheckedByKeyFramesThatWereLeftOut) {
  LabelDesk desk = open();
  for (const std::size_t frame : {0, 5, 10, 15, 20, 25})
    desk.edit(box(frame, 5 + static_cast<double>(frame)));
  const auto checks = check_labels(desk);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].by_hand, 6u);
  EXPECT_EQ(checks[0].by_curve, 20u);
  EXPECT_EQ(checks[0].left_out.size(), 4u) << "nothing reaches the ends";
  EXPECT_LT(*rms_px(checks[0]), 1e-6) << "a straight way";
  EXPECT_EQ(share_within(checks[0], 1), 1.0);
  EXPECT_FALSE(contact_sheet(desk, checks).empty());
}

/// Real footage of a camera that jerks, labelled by clicks where the desk leads, with the truth of its labels.csv.
TEST(Labelling, OfRealFootageIsRightAfterClicksOnFewerThanHalfOfItsFrames) {
  const fs::path klahaag = fs::path(RELOCK_SOURCE_DIR) / "recordings/klahaag";
  const Recording truth = open_sequence(klahaag).recording;
  const Scratch scratch;
  OpenOptions options;
  options.truth = Truth::ignored;
  options.labels = scratch.path() / "labels.csv";
  LabelDesk desk(open_sequence(klahaag, options), {});
  LikenessWatch watch(desk.sequence().frames);
  std::size_t clicks = 0;
  for (;; ++clicks) {
    watch.look_at_labels(desk.document().targets, desk.filled(), desk.version());
    while (!watch.finished()) std::this_thread::yield();
    const Json next = desk.state(watch.known())["targets"][0]["to_go"]["next"];
    if (next.is_null()) break;
    const std::size_t frame = next["frame"];
    Json key{{"do", "key"}, {"target", "shirt"}, {"frame", frame}, {"state", "placed"}, {"sigma_px", 0.7}};
    add_outline(key, *truth.truth_of(frame, 0).outline);
    desk.edit(key);
    ASSERT_LT(clicks, truth.frames());
  }
  EXPECT_LT(clicks, truth.frames() / 2);
  std::size_t within_two = 0, curve = 0;
  for (std::size_t frame = 0; frame < truth.frames(); ++frame) {
    const TargetTruth& label = desk.filled()[0].truth[frame];
    ASSERT_TRUE(label.outline) << frame;
    const Vec2 off = centre_of(*label.outline) - centre_of(*truth.truth_of(frame, 0).outline);
    EXPECT_LT(norm(off), 0.1 * label.size_px()) << frame;
    if (desk.filled()[0].rests_on[frame] != RestsOn::curve) continue;
    ++curve;
    within_two += std::max(std::abs(off.x), std::abs(off.y)) <= 2 * std::hypot(label.sigma_px, 0.7) ? 1 : 0;
  }
  EXPECT_GE(static_cast<double>(within_two), 0.9 * static_cast<double>(curve)) << "as the labels state";
  RecordProperty("clicks", static_cast<int>(clicks));
}

}  // namespace
}  // namespace relock
