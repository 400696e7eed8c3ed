// Agreement with the toolkits of GOT-10k, VOT and evo: tests/data/compatibility/README.md says which versions
// made the expected files, and how.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/benchmark_files.h"
#include "core/error.h"
#include "eval/compatibility/ape.h"
#include "eval/compatibility/got10k.h"
#include "eval/compatibility/otb.h"
#include "eval/compatibility/overlap.h"
#include "eval/compatibility/vot.h"
#include "eval/compatibility/vot_multistart.h"
#include "sequences/benchmark.h"
#include "sequences/vot_region.h"
#include "source_folder.h"

namespace relock {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kData = fs::path(RELOCK_SOURCE_DIR) / "tests/data/compatibility";
constexpr Size kPicture{320, 240};
constexpr double kDouble = 1e-12;
constexpr double kFloat = 2e-7;  // the VOT toolkit averages in single precision

Json expected(const std::string& toolkit) {
  std::ifstream in(kData / ("expected-" + toolkit + ".json"));
  return Json::parse(in);
}

AnsweredSequence boxes(const std::string& name) {
  const fs::path folder = kData / "boxes" / name;
  const auto truth = read_boxes(folder / "groundtruth.txt", Origin::one);
  const auto answers = read_answers(ResultFormat::got10k, folder / "answers.txt");
  const auto cover = read_marks(folder / "cover.label", 8);
  AnsweredSequence sequence{name, kPicture, 0, {}};
  for (std::size_t i = 0; i < truth.size(); ++i)
    sequence.frames.push_back({truth[i], cover[i] / 8.0, i == 0, answers[i].outline});
  return sequence;
}

std::vector<ForeignAnswer> vot_answers(const std::string& name) {
  return read_answers(ResultFormat::vot, kData / "regions" / name / (name + "_001.txt"));
}

AnsweredSequence regions(const std::string& name) {
  const fs::path truth = kData / "regions" / name / "groundtruth.txt";
  const auto lines = lines_of(truth);
  const auto answers = vot_answers(name);
  AnsweredSequence sequence{name, kPicture, 0, {}};
  for (std::size_t i = 0; i < lines.size(); ++i)
    sequence.frames.push_back({vot_region(lines[i], truth.string(), i + 1), 1,
                               answers[i].code == VotCode::start, answers[i].outline});
  return sequence;
}

void expect_near(const std::vector<double>& ours, const Json& theirs, double tolerance) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i)
    EXPECT_NEAR(ours[i], theirs[i].get<double>(), tolerance) << "value " << i;
}

void expect_got10k(const std::vector<AnsweredSequence>& sequences, const Json& theirs) {
  const Got10kScores ours = got10k_scores(sequences);
  EXPECT_EQ(ours.frames, theirs["frames"].get<std::size_t>());
  EXPECT_NEAR(ours.ao.value(), theirs["ao"].get<double>(), kDouble);
  EXPECT_NEAR(ours.sr50.value(), theirs["sr50"].get<double>(), kDouble);
  EXPECT_NEAR(ours.sr75.value(), theirs["success"][75].get<double>(), kDouble);
  expect_near(ours.success, theirs["success"], kDouble);
}

TEST(Got10kScores, AgreeWithTheToolkitOnEverySequenceAndOnAll) {
  const Json theirs = expected("got10k");
  std::vector<AnsweredSequence> all;
  for (const char* name : {"inside", "lost", "border"}) {
    all.push_back(boxes(name));
    expect_got10k({all.back()}, theirs[name]);
  }
  expect_got10k(all, theirs["all"]);
}

void expect_otb(const std::vector<AnsweredSequence>& sequences, const Json& theirs) {
  const OtbScores ours = otb_scores(sequences);
  expect_near(ours.success, theirs["success"], kDouble);
  expect_near(ours.precision, theirs["precision"], kDouble);
  double sum = 0;
  for (const Json& share : theirs["success"]) sum += share.get<double>();
  EXPECT_NEAR(ours.auc.value(), sum / 21, kDouble);
  EXPECT_NEAR(ours.success_rate.value(), theirs["success"][10].get<double>(), kDouble);
  EXPECT_NEAR(ours.precision_20.value(), theirs["precision"][20].get<double>(), kDouble);
}

TEST(OtbScores, AgreeWithTheToolkitOnEverySequenceAndOnAll) {
  const Json theirs = expected("otb");
  const std::vector<AnsweredSequence> all{boxes("inside"), boxes("lost")};
  expect_otb({all[0]}, theirs["inside"]);
  expect_otb({all[1]}, theirs["lost"]);
  expect_otb(all, theirs["all"]);
}

TEST(VotScores, FindTheSameOverlapsAsTheToolkit) {
  const Json theirs = expected("vot");
  for (const char* name : {"boxes", "polygons", "whole"}) {
    const AnsweredSequence sequence = regions(name);
    std::vector<double> ours;
    for (const AnsweredFrame& f : sequence.frames)
      ours.push_back(f.answer ? vot_overlap(*f.answer, *f.truth, kPicture) : 0);
    SCOPED_TRACE(name);
    expect_near(ours, theirs[name]["overlaps"], kDouble);
  }
}

TEST(VotScores, FindTheCodesOfTheFileInWhatItSays) {
  for (const char* name : {"boxes", "polygons", "whole"}) {
    std::vector<VotCode> theirs;
    for (const ForeignAnswer& answer : vot_answers(name)) theirs.push_back(answer.code);
    EXPECT_EQ(vot_codes(regions(name)), theirs) << name;
  }
}

TEST(VotScores, AgreeWithTheToolkit) {
  const Json theirs = expected("vot");
  std::vector<AnsweredSequence> all;
  for (const char* name : {"boxes", "polygons", "whole"}) {
    all.push_back(regions(name));
    const VotScores ours = vot_scores(std::vector{all.back()});
    EXPECT_NEAR(ours.accuracy.value(), theirs[name]["accuracy"].get<double>(), kFloat) << name;
    EXPECT_EQ(ours.failures, theirs[name]["failures"].get<std::size_t>()) << name;
  }
  VotOptions options;
  options.eao_low = theirs["all"]["low"];
  options.eao_high = theirs["all"]["high"];
  const VotScores ours = vot_scores(all, options);
  EXPECT_NEAR(ours.accuracy.value(), theirs["all"]["accuracy"].get<double>(), kFloat);
  EXPECT_NEAR(ours.failures_mean.value(), theirs["all"]["failures_mean"].get<double>(), kDouble);
  EXPECT_NEAR(ours.robustness.value(), theirs["all"]["robustness"].get<double>(), kDouble);
  expect_near(ours.expected_overlap, theirs["all"]["curve"], kFloat);
  EXPECT_NEAR(ours.eao.value(), theirs["all"]["eao"].get<double>(), kFloat);
}

/// A run from an anchor, as it was played.
AnsweredSequence multistart_run(const std::string& name, std::size_t anchor, bool backward) {
  AnsweredSequence all = regions(name);
  const std::size_t frames = all.frames.size();
  if (backward) std::reverse(all.frames.begin(), all.frames.end());
  const std::size_t first = backward ? frames - 1 - anchor : anchor;
  const auto answers =
      read_answers(ResultFormat::vot, kData / "regions" / name / fmt::format("{}_{:08}.txt", name, anchor));
  AnsweredSequence run{name, kPicture, first, {}};
  for (std::size_t i = first; i < frames; ++i)
    run.frames.push_back({all.frames[i].truth, 1, i == first, answers.at(i - first).outline});
  return run;
}

TEST(VotMultistartScores, AgreeWithTheToolkit) {
  const Json theirs = expected("vot-multistart");
  std::vector<AnsweredSequence> runs;
  for (const std::size_t anchor : {0, 60}) runs.push_back(multistart_run("boxes", anchor, false));
  runs.push_back(multistart_run("boxes", 149, true));
  for (const std::size_t anchor : {0, 50, 100}) runs.push_back(multistart_run("polygons", anchor, false));
  runs.push_back(multistart_run("polygons", 199, true));
  VotMultistartOptions options;
  options.eao_low = theirs["low"];
  options.eao_high = theirs["high"];
  const VotMultistartScores ours = vot_multistart_scores(runs, options);
  EXPECT_EQ(ours.runs, 7u);
  EXPECT_GT(ours.failures, 0u);
  EXPECT_NEAR(ours.accuracy.value(), theirs["accuracy"].get<double>(), kDouble);
  EXPECT_NEAR(ours.robustness.value(), theirs["robustness"].get<double>(), kDouble);
  expect_near(ours.expected_overlap, theirs["curve"], kDouble);
  EXPECT_NEAR(ours.eao.value(), theirs["eao"].get<double>(), kDouble);
}

/// Centres of a TUM file by their time as written.
std::map<std::string, Vec2> path_of(const std::string& file) {
  std::map<std::string, Vec2> path;
  std::ifstream in(kData / "paths" / file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::string time;
    Vec2 place;
    cells >> time >> place.x >> place.y;
    path[time] = place;
  }
  return path;
}

Outline around(Vec2 centre) { return Box{centre.x - 1, centre.y - 1, 2, 2}; }

TEST(ApeScores, AgreeWithEvoWithAndWithoutAlignment) {
  const Json theirs = expected("evo");
  const auto truth = path_of("truth.txt"), answers = path_of("answers.txt");
  AnsweredSequence sequence{"path", kPicture, 0, {}};
  for (const auto& [time, place] : truth) {
    sequence.frames.push_back({around(place), 1, false, {}});
    if (answers.contains(time)) sequence.frames.back().answer = around(answers.at(time));
  }
  for (const char* name : {"none", "rigid", "similarity"}) {
    const ApeScores ours = ape_scores(std::vector{sequence}, parse_alignment(name));
    SCOPED_TRACE(name);
    EXPECT_EQ(ours.frames, theirs[name]["frames"].get<std::size_t>());
    EXPECT_NEAR(ours.rmse_px.value(), theirs[name]["rmse"].get<double>(), 1e-9);
    EXPECT_NEAR(ours.mean_px.value(), theirs[name]["mean"].get<double>(), 1e-9);
    EXPECT_NEAR(ours.median_px.value(), theirs[name]["median"].get<double>(), 1e-9);
    EXPECT_NEAR(ours.std_px.value(), theirs[name]["std"].get<double>(), 1e-9);
    EXPECT_NEAR(ours.max_px.value(), theirs[name]["max"].get<double>(), 1e-9);
  }
}

class ResultFiles : public testing::Test {
 protected:
  ~ResultFiles() override { fs::remove_all(folder_); }
  fs::path file(const std::string& text) {
    std::ofstream(folder_ / "answers.txt") << text;
    return folder_ / "answers.txt";
  }
  std::string fault(ResultFormat format, const std::string& text) {
    try {
      read_answers(format, file(text));
    } catch (const Error& error) {
      return fs::path(error.what()).filename().string();
    }
    return "none";
  }

 private:
  static fs::path made() {
    std::string name = (fs::temp_directory_path() / "relock-XXXXXX").string();
    return mkdtemp(name.data());
  }
  fs::path folder_ = made();
};

Recording of_frames(std::size_t frames) {
  Recording recording{"made", kPicture, Duration{40'000'000}, {}, {{"target"}}, {}};
  for (std::size_t i = 0; i < frames; ++i)
    recording.captured.push_back(time_ns(40'000'000 * static_cast<std::int64_t>(i)));
  return recording;
}

TEST_F(ResultFiles, ReadBackGiveTheSameBoxesToATenThousandthOfAPixel) {
  const AnsweredSequence sequence = boxes("inside");
  const Recording recording = of_frames(sequence.frames.size());
  for (const ResultFormat format : {ResultFormat::otb, ResultFormat::got10k}) {
    const auto read = read_answers(format, file(result_text(format, sequence, recording)));
    ASSERT_EQ(read.size(), sequence.frames.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      const Box ours = std::get<Box>(*sequence.frames[i].answer), back = std::get<Box>(*read[i].outline);
      EXPECT_NEAR(back.x, ours.x, 5.1e-5);
      EXPECT_NEAR(back.y, ours.y, 5.1e-5);
      EXPECT_NEAR(back.width, ours.width, 5.1e-5);
      EXPECT_NEAR(back.height, ours.height, 5.1e-5);
    }
  }
}

TEST_F(ResultFiles, OfVotReadBackGiveTheSameCodesAndRegions) {
  for (const char* name : {"boxes", "polygons"}) {
    const AnsweredSequence sequence = regions(name);
    const auto text = result_text(ResultFormat::vot, sequence, of_frames(sequence.frames.size()));
    const auto read = read_answers(ResultFormat::vot, file(text)), before = vot_answers(name);
    ASSERT_EQ(read.size(), before.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].code, before[i].code) << name << " " << i;
      ASSERT_EQ(read[i].outline.has_value(), before[i].outline.has_value());
      if (!read[i].outline) continue;
      EXPECT_EQ(read[i].outline->index(), before[i].outline->index());
      EXPECT_NEAR(norm(centre_of(*read[i].outline) - centre_of(*before[i].outline)), 0, 1e-4);
    }
  }
}

TEST_F(ResultFiles, SayWhereTheMethodSaidNothing) {
  AnsweredSequence sequence = boxes("inside");
  sequence.frames[7].answer.reset();
  sequence.first_frame = 2;
  const Recording recording = of_frames(sequence.frames.size() + 2);
  const auto read =
      read_answers(ResultFormat::otb, file(result_text(ResultFormat::otb, sequence, recording)));
  EXPECT_FALSE(read[0].outline || read[1].outline || read[9].outline);
  EXPECT_TRUE(read[2].outline && read[8].outline && read[10].outline);
  const std::string path = result_text(ResultFormat::tum, sequence, recording);
  EXPECT_EQ(std::count(path.begin(), path.end(), '\n'), 118);  // 120 frames, one given, one without answer
  EXPECT_TRUE(path.starts_with("0.120000000 ")) << path.substr(0, 40);
}

TEST_F(ResultFiles, WithFaultsAreRefusedWithTheirLine) {
  EXPECT_EQ(fault(ResultFormat::otb, "1,2,3,4\n1,2,3\n"),
            "answers.txt:2: a box is x, y, width, height; there are 3");
  EXPECT_EQ(fault(ResultFormat::got10k, "1,2,3,4\n1,2,three,4\n"), "answers.txt:2: \"three\" is no number");
  EXPECT_EQ(fault(ResultFormat::otb, "1,2,3,4\n1,2,-3,4\n"), "answers.txt:2: a box of -3 by 4 is none");
  EXPECT_EQ(fault(ResultFormat::vot, "1\n5\n"),
            "answers.txt:2: 5 is no code; they are 0 (nothing), 1 (start), 2 (failure)");
  EXPECT_EQ(fault(ResultFormat::vot, "1\n1,2,3,4,5\n").substr(0, 14), "answers.txt:2:");
  EXPECT_EQ(fault(ResultFormat::otb, "1,2,3,4\nnan,nan,nan,nan\n"), "none");  // nothing said
}

}  // namespace
}  // namespace relock
