#include "cli/reproduce/pictures.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "cli/files.h"
#include "cli/judged_picture.h"
#include "cli/print/targets.h"
#include "cli/reproduce/canvas_run.h"
#include "cli/reproduce/contenders.h"
#include "core/error.h"
#include "core/opencv.h"
#include "sequences/open.h"
#include "sequences/simulator/flight.h"

namespace relock::reproduction {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastBlur_px = 15, kMostBlur_px = 30;
constexpr const char* kRule =
    "the first frame of a fixed flight on which every ring is whole in the picture and blurred by 15 to 30 "
    "px";

/// The paper's detector, if there is one.
std::unique_ptr<Detector> ring_detector(const Methods& methods) {
  const std::string method = ring_methods().front().method;
  if (!is_built_in(methods, method)) return {};
  return choose_detector(methods, method).make();
}

Finding begun(const std::string& id, const std::string& title, const Methods& methods) {
  Finding finding;
  finding.id = id;
  finding.title = title;
  finding.sentences = missing_methods(methods, {ring_methods().front().method});
  return finding;
}

/// Of flights that have a frame by the rule within 0.2 s.
constexpr std::array<std::uint64_t, 4> kSeedsOfFigure8{4, 6, 12, 14};
constexpr std::uint64_t kSeedOfFigure9 = 10;

/// A jerky flight near a target, so that a ring has some 100 px.
simulator::FlightPlan near_flight(std::uint64_t seed) {
  simulator::FlightPlan plan = simulator::flight_preset("violent");
  plan.seed = seed;
  plan.duration_s = 0.2;
  plan.motion.distance_m = 0.5;
  return plan;
}

/// The four rings side by side need a wider picture to be as large.
simulator::FlightPlan wide_flight(std::uint64_t seed) {
  simulator::FlightPlan plan = near_flight(seed);
  plan.camera.width = 1280, plan.camera.height = 720;
  plan.motion.distance_m = 1;
  plan.targets = simulator::flight_preset("wall4").targets;
  return plan;
}

/// Flies unless the same flight is in `folder` already.
Sequence flown(const fs::path& folder, const simulator::FlightPlan& plan, int jobs) {
  const fs::path as_flown = folder / "flight.toml";
  if (!fs::exists(as_flown) || read_file(as_flown) != simulator::flight_plan_text(plan)) {
    fs::remove_all(folder);
    make_folder(folder.parent_path());
    simulator::FlightOptions options;
    options.jobs = jobs;
    simulator::fly(plan, print_target, folder, options);
  }
  return open_sequence(folder);
}

double blur_px(const TargetTruth& truth) { return truth.blur ? std::hypot(truth.blur->x, truth.blur->y) : 0; }

bool fits_the_rule(const TargetTruth& truth) {
  return truth.label == Label::visible && truth.visible_fraction > 0.999 && blur_px(truth) >= kLeastBlur_px &&
         blur_px(truth) <= kMostBlur_px;
}

/// A frame of a flight and what is true of it.
struct ChosenFrame {
  cv::Mat picture;
  Recording recording;  ///< of this frame alone
};

ChosenFrame first_by_the_rule(const Sequence& sequence, const fs::path& folder) {
  const Recording& recording = sequence.recording;
  const auto source = sequence.frames();
  for (std::size_t frame = 0; frame < recording.frames() && source->next(); ++frame) {
    bool fits = true;
    for (std::size_t target = 0; target < recording.targets.size(); ++target)
      fits &= fits_the_rule(recording.truth_of(frame, target));
    if (!fits) continue;
    ChosenFrame chosen{read_only_mat(source->image()).clone(), recording};
    chosen.recording.captured = {recording.captured[frame]};
    chosen.recording.truth.clear();
    for (std::size_t target = 0; target < recording.targets.size(); ++target)
      chosen.recording.truth.push_back(recording.truth_of(frame, target));
    return chosen;
  }
  throw Error(fmt::format("{} has no frame by the rule: {}", folder.string(), kRule));
}

/// Which of a frame's targets were recognised, by the evaluator.
std::vector<Verdict> verdicts(const Recording& recording, const Sightings& sightings) {
  std::vector<Verdict> all;
  for (const Judgement& judgement : judged_alone(recording, sightings).targets)
    all.push_back(judgement.verdict);
  return all;
}

const char* in_words(Verdict verdict) {
  switch (verdict) {
    case Verdict::Hit:
      return "found";
    case Verdict::WrongId:
      return "read as another code";
    case Verdict::Stray:
      return "found in the wrong place";
    default:
      return "not found";
  }
}

/// "ring:01, blur 18 px: found"
std::string told(const Recording& recording, std::size_t target, Verdict verdict) {
  return fmt::format("{}, blur {:.0f} px: {}", recording.targets[target].id, blur_px(recording.truth[target]),
                     in_words(verdict));
}

Json json_of(const Recording& recording, std::size_t target, Verdict verdict) {
  return {{"target", recording.targets[target].id},
          {"blur_px", number(blur_px(recording.truth[target]))},
          {"size_px", number(recording.truth[target].size_px())},
          {"verdict", std::string(to_string(verdict))}};
}

}  // namespace

std::vector<Finding> figure_8(const Settings& settings, const Methods& methods) {
  Finding finding = begun("figure-8", "a ring of each code in a blurred frame", methods);
  const auto detector = ring_detector(methods);
  if (!detector) return {finding};
  std::vector<cv::Mat> pictures;
  finding.figures = Json::array();
  for (std::size_t i = 0; i < ring_codes().size(); ++i) {
    const fs::path folder = settings.out / "frames" / ("figure-8-" + ring_codes()[i]);
    simulator::FlightPlan plan = near_flight(kSeedsOfFigure8[i]);
    plan.targets = {{ring_target(ring_codes()[i])}};
    const ChosenFrame frame = first_by_the_rule(flown(folder, plan, settings.jobs), folder);
    const Sightings seen = detector->detect(view(frame.picture));
    const Verdict verdict = verdicts(frame.recording, seen).front();
    pictures.push_back(captioned(with_answers(frame.picture, seen), told(frame.recording, 0, verdict)));
    finding.sentences.push_back(told(frame.recording, 0, verdict) + ".");
    finding.figures.push_back(json_of(frame.recording, 0, verdict));
  }
  finding.sentences.push_back(fmt::format("Shown is {}.", kRule));
  finding.pictures = {write_figure(settings, finding.id, in_rows(pictures, 2))};
  return {finding};
}

std::vector<Finding> figure_9(const Settings& settings, const Methods& methods) {
  Finding finding = begun("figure-9", "several rings in one frame", methods);
  const auto detector = ring_detector(methods);
  if (!detector) return {finding};
  const fs::path folder = settings.out / "frames" / "figure-9";
  const ChosenFrame frame =
      first_by_the_rule(flown(folder, wide_flight(kSeedOfFigure9), settings.jobs), folder);
  const Sightings seen = detector->detect(view(frame.picture));
  const std::vector<Verdict> all = verdicts(frame.recording, seen);
  std::string caption;
  finding.figures = Json::array();
  for (std::size_t target = 0; target < all.size(); ++target) {
    caption += (target > 0 ? "; " : "") + told(frame.recording, target, all[target]);
    finding.sentences.push_back(told(frame.recording, target, all[target]) + ".");
    finding.figures.push_back(json_of(frame.recording, target, all[target]));
  }
  finding.sentences.push_back(fmt::format(
      "Shown is {}; it has 1280x720 px, so that four rings beside each other have 100 px each.", kRule));
  finding.pictures = {
      write_figure(settings, finding.id, captioned(with_answers(frame.picture, seen), caption))};
  return {finding};
}

std::vector<Finding> figure_10(const Settings& settings, const Methods& methods) {
  Finding finding = begun("figure-10", "rings on the canvas under blur of 50 px and more", methods);
  const auto detector = ring_detector(methods);
  if (!detector) return {finding};
  simulator::CanvasPlan plan;
  plan.canvas_px = 320;
  plan.lengths_px = {50, 65, 80};
  plan.angles_deg = {0, 45, 90, 135};
  if (!settings.quick) plan.angles_deg = {0, 22, 45, 67, 90, 112, 135, 157};
  simulator::check_canvas(plan);
  std::vector<cv::Mat> pictures;
  std::size_t found = 0;
  finding.figures = Json::array();
  for (std::size_t rank = 0; rank < simulator::canvas_pictures(plan); ++rank) {
    const std::size_t row = rank / plan.angles_deg.size(), column = rank % plan.angles_deg.size();
    const PrintedTarget target =
        target_on_canvas(ring_target(ring_codes()[(row + column) % ring_codes().size()]));
    const auto picture = simulator::canvas_picture(plan, target, rank, 10);
    const Sightings seen = detector->detect(view(picture.pixels));
    const PictureAnswer answer = judged(target, picture, seen);
    found += answer.recognised() ? 1 : 0;
    pictures.push_back(captioned(with_answers(picture.pixels, seen),
                                 fmt::format("{}, {:g} px at {:g}: {}", target.name, plan.lengths_px[row],
                                             plan.angles_deg[column], in_words(answer.verdict))));
    finding.figures.push_back({{"target", target.name},
                               {"blur_px", plan.lengths_px[row]},
                               {"angle_deg", plan.angles_deg[column]},
                               {"verdict", std::string(to_string(answer.verdict))}});
  }
  finding.sentences.push_back(fmt::format("{} of {} rings were recognised.", found, pictures.size()));
  finding.pictures = {
      write_figure(settings, finding.id, in_rows(pictures, static_cast<int>(plan.angles_deg.size())))};
  return {finding};
}

}  // namespace relock::reproduction
