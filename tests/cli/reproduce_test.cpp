#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "cli/files.h"
#include "cli/in_parallel.h"
#include "cli/method_spec.h"
#include "cli/print/targets.h"
#include "cli/reproduce/canvas_run.h"
#include "cli/reproduce/folder.h"
#include "cli/reproduce/localization.h"
#include "cli/reproduce/paper.h"
#include "cli/reproduce/rates.h"
#include "cli/reproduce/report.h"
#include "core/error.h"
#include "core/nearest.h"

namespace relock::reproduction {
namespace {

namespace fs = std::filesystem;

/// A folder of a test's own, gone with it.
class Reproduction : public testing::Test {
 protected:
  Reproduction()
      : out_(fs::temp_directory_path() /
             (std::string("relock-reproduction-") +
              testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(getpid()))) {
    fs::remove_all(out_);
  }
  ~Reproduction() override { fs::remove_all(out_); }

  Settings settings(int jobs = 1) const { return {.out = out_, .quick = true, .jobs = jobs}; }
  std::string refusal(const Settings& settings) const {
    try {
      prepare_reproduction(settings);
    } catch (const Error& fault) {
      return fault.what();
    }
    return "";
  }

  fs::path out_;
};

CanvasExperiment tiny() {
  CanvasExperiment experiment{"tiny", {}, 3};
  experiment.plan.canvas_px = 240;
  experiment.plan.marker_px = 100;
  experiment.plan.lengths_px = {2, 60};
  experiment.plan.angles_deg = {0, 50};
  return experiment;
}

const std::vector<Contender> kTwo{{"aruco(dictionary=4x4_50)", "aruco4x4_50:7"},
                                  {"aruco(dictionary=6x6_250)", "aruco6x6_250:7"}};

fs::path answers_file(const fs::path& out, std::size_t contender) {
  return out / "tiny" / slug(kTwo[contender].method) / (slug(kTwo[contender].target) + ".csv");
}

PictureAnswer hit(double blur, double along, double across) {
  return {.blur_px = blur,
          .angle_deg = 0,
          .verdict = Verdict::Hit,
          .error_px = std::hypot(along, across),
          .along_px = along,
          .across_px = across};
}
PictureAnswer miss(double blur) { return {.blur_px = blur, .verdict = Verdict::Miss}; }

TEST(ThePaper, PrintsRatesOfRisingBlurThatNeverRise) {
  for (const auto* published : {&paper::pitag(), &paper::artag(), &paper::ring("00"), &paper::ring("01"),
                                &paper::ring("10"), &paper::ring("11")}) {
    ASSERT_GE(published->rates.size(), 4u);
    for (std::size_t i = 1; i < published->rates.size(); ++i) {
      EXPECT_LT(published->rates[i - 1].blur_px, published->rates[i].blur_px);
      EXPECT_GE(published->rates[i - 1].percent, published->rates[i].percent);
    }
  }
  EXPECT_EQ(paper::artag().at(35), 19);
  EXPECT_FALSE(paper::artag().at(40));
}

TEST(ThePaper, LosesNoCodeBut00) {
  EXPECT_EQ(paper::ring("00").at(45), 100);
  EXPECT_EQ(paper::ring("00").at(50), 0);
  for (const char* code : {"01", "10", "11"}) EXPECT_EQ(paper::ring(code).at(65), 100) << code;
  EXPECT_TRUE(paper::ring("001").rates.empty());
}

TEST(ThePaper, SaysOfItsTablesWhatTheyHold) {
  for (const paper::CentreError& row : paper::centre_errors())
    EXPECT_LT(row.mean_px, paper::kMeanErrorWithin_px);
  for (const paper::RecordedTest& test : paper::recorded_tests()) {  // "86.5% to 94.1%", "60.3% to 65.6%"
    EXPECT_TRUE(test.ring_percent >= 86.5 && test.ring_percent <= 94.1);
    EXPECT_TRUE(test.artag_percent >= 60.3 && test.artag_percent <= 65.6);
    EXPECT_NEAR(test.frames, 1100, 110);  // "around 1000 frames"
  }
}

TEST(Contenders, ShowEveryGridOnceToADetectorThatReadsIt) {
  const Methods methods = builtin_methods();
  EXPECT_EQ(squares_built_in(methods).size(), square_markers().size());
  for (const Contender& marker : square_markers()) {
    const MethodSpec spec = parse_methods(marker.method).front();
    const DetectorEntry& entry = *methods.detectors.find(spec.name);
    const auto families = entry.reads(Options(entry.name, entry.options, spec.options));
    EXPECT_EQ(families.front(), print_target(marker.target, 0.1).code->family) << marker.method;
  }
}

TEST(Contenders, ThatAreMissingAreToldOnceEach) {
  const auto told = missing_methods(builtin_methods(), {"aruco", "nobody(x=1)", "nobody"});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told.front().find("nobody"), std::string::npos);
}

TEST(Judged, SplitsTheErrorAlongAndAcrossTheBlur) {
  const PrintedTarget target = target_on_canvas("aruco4x4_50:7");
  simulator::CanvasPlan plan = tiny().plan;
  const auto picture = simulator::canvas_picture(plan, target, 3, 1);  // 60 px at 50 degrees
  const double angle = 50 * M_PI / 180;
  const Vec2 blur{std::cos(angle), std::sin(angle)}, across{-blur.y, blur.x};
  Sighting sighting = sighting_of(*picture.truth.outline);
  sighting.code = target.code;
  sighting.centre = sighting.centre + 3 * blur + -4 * across;
  const PictureAnswer answer = judged(target, picture, {sighting});
  EXPECT_TRUE(answer.recognised());
  EXPECT_NEAR(*answer.error_px, 5, 1e-9);
  EXPECT_NEAR(*answer.along_px, 3, 1e-9);
  EXPECT_NEAR(*answer.across_px, -4, 1e-9);
}

TEST(Judged, RecognisesNoMarkerWithoutItsCode) {
  const PrintedTarget target = target_on_canvas("aruco4x4_50:7");
  const auto picture = simulator::canvas_picture(tiny().plan, target, 0, 1);
  Sighting sighting = sighting_of(*picture.truth.outline);
  EXPECT_FALSE(judged(target, picture, {sighting}).recognised());
  sighting.code = Code{"aruco4x4_50", "8"};
  EXPECT_EQ(judged(target, picture, {sighting}).verdict, Verdict::WrongId);
  EXPECT_EQ(judged(target, picture, {}).verdict, Verdict::Miss);
}

TEST(Rates, CountPicturesOfEachLengthAndTellWhereThePrintedOneIsOutside) {
  std::vector<PictureAnswer> answers;
  for (int i = 0; i < 10; ++i) {
    answers.push_back(hit(35, 0, 0));
    answers.push_back(i < 2 ? hit(15, 0, 0) : miss(15));
  }
  const auto rates = rates_by_blur(answers);
  ASSERT_EQ(rates.size(), 2u);
  EXPECT_EQ(rates[0].blur_px, 15);
  EXPECT_EQ(rate_text(rates[0]), "20 [6, 51]");  // Wilson, of 2 in 10
  EXPECT_EQ(rate_text(rate_at(rates, 40)), "n/a");
  const auto told = departures("it", rates, paper::artag());
  ASSERT_TRUE(told);
  EXPECT_NE(told->find("15 px (20 % [6, 51], printed 100), 35 px (100 %"), std::string::npos) << *told;
  EXPECT_FALSE(departures("it", {rates[1]}, paper::ring("01")));
}

TEST(CentreErrors, AreThoseOfRecognisedPictures) {
  const CentreErrors errors = centre_errors({hit(30, 1, 0), hit(30, 0, 3), miss(30)});
  EXPECT_EQ(errors.pictures, 3);
  EXPECT_EQ(errors.recognised, 2);
  EXPECT_DOUBLE_EQ(*errors.mean_px, 2);
  EXPECT_DOUBLE_EQ(*errors.deviation_px, std::sqrt(2));
  EXPECT_NEAR(errors.interval->high - 2, 12.706, 1e-3);  // t of one degree of freedom, times 1
  EXPECT_DOUBLE_EQ(*errors.along_px, std::sqrt(0.5));
  EXPECT_FALSE(centre_errors({miss(30)}).mean_px);
  EXPECT_FALSE(centre_errors({hit(30, 1, 0)}).interval);
}

TEST(InParallel, DoesEverythingOnceAndThrowsOnWhatWasThrown) {
  std::vector<std::atomic<int>> done(100);
  in_parallel(done.size(), 3, [&] { return [&](std::size_t i) { ++done[i]; }; });
  EXPECT_TRUE(std::all_of(done.begin(), done.end(), [](const auto& times) { return times == 1; }));
  EXPECT_THROW(in_parallel(100, 3,
                           [] {
                             return [](std::size_t i) {
                               if (i == 7) throw Error("seven");
                             };
                           }),
               Error);
}

TEST_F(Reproduction, OfACanvasHasTheSameBytesForAnyNumberOfJobs) {
  const Methods methods = builtin_methods();
  run_canvas(tiny(), kTwo, settings(1), methods);
  const std::string one = read_file(answers_file(out_, 0));
  fs::remove_all(out_);
  const auto results = run_canvas(tiny(), kTwo, settings(2), methods);
  EXPECT_EQ(read_file(answers_file(out_, 0)), one);
  EXPECT_TRUE(results[0].answers[0].recognised());   // 2 px of blur
  EXPECT_FALSE(results[0].answers[3].recognised());  // 60 px
  EXPECT_EQ(results[0].answers[3].angle_deg, 50);
}

TEST_F(Reproduction, MakesOnlyWhatIsMissing) {
  const Methods methods = builtin_methods();
  run_canvas(tiny(), kTwo, settings(), methods);
  const std::string first = read_file(answers_file(out_, 0));
  std::string second = read_file(answers_file(out_, 1));
  second.replace(second.rfind("Miss"), 4, "Stray");  // to be known again
  write_file(answers_file(out_, 1), second);
  fs::remove(answers_file(out_, 0));
  const auto results = run_canvas(tiny(), kTwo, settings(), methods);
  EXPECT_EQ(read_file(answers_file(out_, 0)), first);
  EXPECT_EQ(results[1].answers.back().verdict, Verdict::Stray);
}

TEST_F(Reproduction, MakesAnewWhatAnotherPlanOrOtherOptionsMade) {
  const Methods methods = builtin_methods();
  const std::vector<Contender> one{kTwo[0]};
  run_canvas(tiny(), one, settings(), methods);
  const std::string first = read_file(answers_file(out_, 0));
  CanvasExperiment other = tiny();
  other.seed = 4;
  run_canvas(other, one, settings(), methods);
  EXPECT_NE(read_file(answers_file(out_, 0)), first);
  run_canvas(tiny(), one, settings(), methods);
  EXPECT_EQ(read_file(answers_file(out_, 0)), first);
}

TEST_F(Reproduction, TellsOfAnswersThatWereCutOff) {
  const Methods methods = builtin_methods();
  run_canvas(tiny(), kTwo, settings(), methods);
  std::string rows = read_file(answers_file(out_, 0));
  rows.erase(rows.rfind('\n', rows.size() - 2) + 1);
  write_file(answers_file(out_, 0), rows);
  EXPECT_THROW(run_canvas(tiny(), kTwo, settings(), methods), Error);
}

TEST_F(Reproduction, MarksEveryTitleAndFileQuick) {
  Finding finding;
  finding.id = "figure-11";
  finding.title = "rings";
  finding.plots = {Plot{.title = "a plot", .x = {}, .y = {}, .curves = {}}};
  std::vector<Finding> findings{finding};
  mark_quick(findings, settings());
  EXPECT_EQ(findings[0].title, "Figure 11 QUICK: rings");
  EXPECT_EQ(std::get<Plot>(findings[0].plots[0]).title, "QUICK: a plot");
  EXPECT_EQ(file_of(settings(), "figure-11", 1, ".svg").filename(), "figure-11-QUICK-2.svg");
  std::vector<Finding> full{finding};
  mark_quick(full, {.out = out_});
  EXPECT_EQ(full[0].title, "Figure 11: rings");
  EXPECT_EQ(file_of({.out = out_}, "figure-11", 0, ".svg").filename(), "figure-11.svg");
}

TEST_F(Reproduction, StaysInAFolderOfItsOwnAndOfItsMode) {
  EXPECT_EQ(refusal(settings()), "");
  EXPECT_EQ(refusal(settings()), "");
  EXPECT_NE(refusal({.out = out_}).find("holds a quick reproduction, not a full one"), std::string::npos);
  fs::remove_all(out_);
  make_folder(out_);
  write_file(out_ / "thesis.txt", "");
  EXPECT_NE(refusal(settings()).find("holds something else"), std::string::npos);
  EXPECT_NE(refusal({.out = out_ / "thesis.txt"}).find("is a file"), std::string::npos);
}

TEST(Experiments, HaveNamesOfTheirOwn) {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiments()) names.push_back(experiment.name);
  EXPECT_GE(names.size(), 6u);
  EXPECT_EQ(nearest_name("figure11", names), "figure-11");
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace relock::reproduction
