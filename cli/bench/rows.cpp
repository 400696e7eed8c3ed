#include "cli/bench/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cli/bench/times.h"
#include "cli/bench/violent.h"
#include "cli/table.h"

namespace relock::bench {
namespace {

constexpr std::size_t kSample = 24, kFull = 400;

Goal at_least(std::optional<double> must, std::optional<double> aim) {
  return {Goal::Sense::least, must, aim};
}
Goal at_most(std::optional<double> must, std::optional<double> aim) { return {Goal::Sense::most, must, aim}; }

simulator::StillPlan clutter_plan(simulator::Range size_px, simulator::Range tilt_deg, double blur_px) {
  simulator::StillPlan plan;
  plan.size_px = size_px, plan.tilt_deg = tilt_deg;
  plan.blurs_px = {blur_px};
  return plan;
}

/// In clutter, tilted by up to 45 degrees, as the issue of most interest has it: D 150 px.
PictureKind clutter(const Bench& bench, double blur_px) {
  return stills(fmt::format("clutter, D 150 px, tilt to 45 degrees, blur {:g} px", blur_px),
                clutter_plan({150, 150}, {0, 45}, blur_px), bench.targets(), bench.settings().seeds);
}
PictureKind canvas_of_150(const Bench& bench, double blur_px) {
  return canvas(fmt::format("canvas, D 150 px, blur {:g} px", blur_px), 150, blur_px, bench.targets(),
                bench.settings().seeds);
}

const std::vector<Look>& clutter_looks(Bench& bench, double blur_px) {
  return bench.looks(clutter(bench, blur_px), bench.count(kSample, kFull));
}
const std::vector<Look>& canvas_looks(Bench& bench, double blur_px) {
  return bench.looks(canvas_of_150(bench, blur_px), bench.count(kSample, kFull));
}

std::vector<Measured> measure_canvas(Bench& bench) {
  std::vector<Look> to_80;
  for (const double blur : {0, 15, 30, 50, 65, 80}) {
    const auto& looks = canvas_looks(bench, blur);
    to_80.insert(to_80.end(), looks.begin(), looks.end());
  }
  std::vector<Measured> all{
      recognised("canvas", "canvas, D 150 px, blur 0 to 80 px", to_80, at_least(100, 100))};
  const std::vector<std::pair<double, Goal>> longer{
      {100, at_least(99, 100)}, {120, at_least(97, 100)}, {150, at_least({}, 90)}};
  for (const auto& [blur, goal] : longer)
    all.push_back(recognised("canvas", canvas_of_150(bench, blur).name, canvas_looks(bench, blur), goal));
  return all;
}

std::vector<Measured> measure_clutter(Bench& bench) {
  const std::vector<std::pair<double, Goal>> cells{{0, at_least(98.5, 99.5)}, {30, at_least(98, 99)},
                                                   {50, at_least(97, 98)},    {65, at_least(96, 98)},
                                                   {80, at_least(94, 97)},    {100, at_least(88, 93)}};
  std::vector<Measured> all;
  for (const auto& [blur, goal] : cells)
    all.push_back(recognised("clutter", clutter(bench, blur).name, clutter_looks(bench, blur), goal));
  return all;
}

std::vector<Measured> measure_sizes(Bench& bench) {
  const std::vector<std::pair<double, Goal>> cells{
      {0, at_least(99, 99.5)}, {15, at_least(99, 99.5)}, {30, at_least(97, 99.5)}};
  std::vector<Measured> all;
  for (const auto& [blur, goal] : cells) {
    const PictureKind kind =
        stills(fmt::format("clutter, D 60 to 150 px, tilt to 45 degrees, blur {:g} px", blur),
               clutter_plan({60, 150}, {0, 45}, blur), bench.targets(), bench.settings().seeds);
    all.push_back(recognised("sizes", kind.name, bench.looks(kind, bench.count(kSample, kFull)), goal));
  }
  return all;
}

/// As a sensor blurs: light, and the picture is coded afterwards. The other rows blur coded pictures, as the paper does.
std::vector<Measured> measure_light(Bench& bench) {
  std::vector<Measured> all;
  for (const double blur : {15, 30, 65, 100}) {
    simulator::StillPlan plan = clutter_plan({150, 150}, {0, 45}, blur);
    plan.blur_in = simulator::BlurIn::light;
    const PictureKind kind =
        stills(fmt::format("clutter, D 150 px, tilt to 45 degrees, blur {:g} px in light", blur), plan,
               bench.targets(), bench.settings().seeds);
    all.push_back(recognised("light", kind.name, bench.looks(kind, bench.count(kSample, kFull)), {}));
  }
  return all;
}

std::vector<double> centre_errors(const std::vector<Look>& looks) {
  std::vector<double> errors;
  for (const Look& look : looks)
    if (look.centre_px) errors.push_back(*look.centre_px);
  return errors;
}

std::vector<Measured> measure_centre(Bench& bench) {
  std::vector<double> on_canvas;
  for (const double blur : {0, 15, 30, 50, 65, 80, 100}) {
    const auto errors = centre_errors(canvas_looks(bench, blur));
    on_canvas.insert(on_canvas.end(), errors.begin(), errors.end());
  }
  std::vector<Measured> all{
      median("centre", "centre, canvas, D 150 px, blur 0 to 100 px", "px", on_canvas, at_most(.05, .03))};
  const std::vector<std::pair<double, Goal>> cells{
      {15, at_most(.06, .04)}, {40, at_most(.12, .1)}, {65, at_most(.25, .2)}};
  for (const auto& [blur, goal] : cells)
    all.push_back(median("centre", "centre, " + clutter(bench, blur).name, "px",
                         centre_errors(clutter_looks(bench, blur)), goal));
  return all;
}

std::vector<Measured> measure_blur(Bench& bench) {
  std::vector<double> directions, lengths;
  for (const double blur : {15, 30, 50, 65, 80, 100})
    for (const auto* looks : {&canvas_looks(bench, blur), &clutter_looks(bench, blur)})
      for (const Look& look : *looks) {
        if (look.direction_deg) directions.push_back(*look.direction_deg);
        if (look.length_percent) lengths.push_back(*look.length_percent);
      }
  return {median("blur", "blur's direction, 15 to 100 px, canvas and clutter", "degrees", directions,
                 at_most(.5, .2)),
          median("blur", "blur's length, 15 to 100 px, canvas and clutter", "%", lengths, at_most(1, .5))};
}

/// What was recognised at some steps of a quantity, and the last step before which the rate is high throughout,
/// beginning with the easiest.
struct Reach {
  std::optional<double> reached;
  std::size_t pictures = 0;
  std::string detail;
};
Reach reach(const std::vector<double>& from_easy_to_hard, double least_percent,
            const std::function<const std::vector<Look>&(double step)>& looks) {
  Reach reach;
  bool high = true;
  for (const double step : from_easy_to_hard) {
    const Measured rate = recognised("", "", looks(step), {});
    reach.pictures += rate.pictures;
    reach.detail +=
        fmt::format("{}{:g}: {:.0f}", reach.detail.empty() ? "" : ", ", step, rate.value.value_or(0));
    high = high && rate.value.value_or(0) >= least_percent;
    if (high) reach.reached = step;
  }
  reach.detail = "recognised at " + reach.detail + " %";
  return reach;
}

std::vector<Measured> measure_smallest(Bench& bench) {
  const std::size_t count = bench.count(16, 120);
  const auto line = [&](const std::string& what, const Goal& goal, const Reach& reach) {
    return Measured{"smallest", what, "px", reach.reached, {}, reach.pictures, goal, reach.detail};
  };
  const auto plain = reach(
      {40, 32, 28, 26, 24, 22, 20, 18, 16}, 95, [&](double size) -> auto& {
        return bench.looks(canvas(fmt::format("canvas, D {:g} px, sharp", size), size, 0, bench.targets(),
                                  bench.settings().seeds),
                           count);
      });
  const auto cluttered = reach(
      {48, 40, 36, 32, 30, 28, 26, 24, 22, 20}, 95, [&](double size) -> auto& {
        return bench.looks(
            stills(fmt::format("clutter, D {:g} px, tilt to 20 degrees, sharp", size),
                   clutter_plan({size, size}, {0, 20}, 0), bench.targets(), bench.settings().seeds),
            count);
      });
  return {
      line("smallest sharp marker read in 95 %, canvas", at_most(22, 18), plain),
      line("smallest sharp marker read in 95 %, clutter, tilt to 20 degrees", at_most(30, 22), cluttered)};
}

std::vector<Measured> measure_tilt(Bench& bench) {
  const std::size_t count = bench.count(16, 120);
  const auto line = [&](const std::string& where, simulator::Backdrop backdrop, const Goal& goal) {
    const Reach far = reach(
        {40, 50, 55, 60, 65, 70, 75, 80}, 90, [&](double tilt) -> auto& {
          simulator::StillPlan plan = clutter_plan({150, 150}, {tilt, tilt}, 0);
          plan.backdrop = backdrop;
          if (backdrop == simulator::Backdrop::plain) plan.noise = {2, 2};
          return bench.looks(stills(fmt::format("{}, D 150 px, tilt {:g} degrees, sharp", where, tilt), plan,
                                    bench.targets(), bench.settings().seeds),
                             count);
        });
    return Measured{"tilt",    fmt::format("largest tilt read in 90 %, {}, D 150 px, sharp", where),
                    "degrees", far.reached,
                    {},        far.pictures,
                    goal,      far.detail};
  };
  return {line("plain", simulator::Backdrop::plain, at_least(65, 75)),
          line("clutter", simulator::Backdrop::clutter, at_least(55, 70))};
}

std::vector<Measured> measure_pose(Bench& bench) {
  std::vector<Measured> all;
  for (const double blur : {0, 15, 30}) {
    const PictureKind kind =
        stills(fmt::format("clutter, D 60 to 150 px, tilt to 45 degrees, blur {:g} px", blur),
               clutter_plan({60, 150}, {0, 45}, blur), bench.targets(), bench.settings().seeds);
    std::vector<double> depths, normals;
    for (const Look& look : bench.looks(kind, bench.count(kSample, kFull))) {
      if (look.depth_percent) depths.push_back(*look.depth_percent);
      if (look.normal_deg) normals.push_back(*look.normal_deg);
    }
    all.push_back(median("pose", fmt::format("pose's depth, D 60 to 150 px, blur {:g} px", blur), "%", depths,
                         at_most(1, .3)));
    all.push_back(median("pose", fmt::format("pose's normal, D 60 to 150 px, blur {:g} px", blur), "degrees",
                         normals, at_most(2, .5)));
  }
  return all;
}

/// A coloured sheet is a dark grey one to a detector that looks at grey: what does that cost?
std::vector<Measured> measure_contrast(Bench& bench) {
  std::vector<Measured> all;
  for (const double black : {30, 60, 90, 120, 150}) {
    simulator::StillPlan plan = clutter_plan({150, 150}, {0, 45}, 65);
    plan.black = {black, black}, plan.white = {210, 210};
    const PictureKind kind = stills(
        fmt::format("clutter, D 150 px, blur 65 px, black at {:g} and white at 210 grey levels", black), plan,
        bench.targets(), bench.settings().seeds);
    const auto& looks = bench.looks(kind, bench.count(kSample, kFull));
    all.push_back(recognised("contrast", kind.name, looks, {}));
    all.back().detail =
        fmt::format("centre's median {} px", cell(median("", "", "", centre_errors(looks), {}).value, 3));
  }
  return all;
}

std::vector<Measured> measure_false_positives(Bench& bench) {
  std::size_t pictures = 0;
  double found = 0;
  for (const double blur : {0, 15, 30, 45, 60}) {
    simulator::StillPlan plan;
    plan.blurs_px = {blur};
    const PictureKind kind =
        stills(fmt::format("clutter without a marker, blur {:g} px", blur), plan, {}, bench.settings().seeds);
    for (const Look& look : bench.looks(kind, bench.count(kSample, 600))) ++pictures, found += look.wrong;
  }
  const auto n = static_cast<double>(pictures);
  const Interval rate = poisson_rate(static_cast<std::size_t>(found), n);
  return {{"false-positives", "false positives, clutter without a marker, blur 0 to 60 px", "per 1000",
           1000 * found / n, Interval{1000 * rate.low, 1000 * rate.high}, pictures, at_most(1, 0),
           fmt::format("{:g} in {} pictures", found, pictures)}};
}

std::vector<Measured> measure_wrong_codes(Bench& bench) {
  if (bench.all().empty()) measure_clutter(bench);
  std::size_t accepted = 0, wrong = 0;
  for (const auto& [name, looks] : bench.all())
    for (const Look& look : looks) {
      wrong += static_cast<std::size_t>(look.wrong);
      accepted += static_cast<std::size_t>(look.wrong) + look.recognised;
    }
  const auto n = static_cast<double>(accepted);
  const Interval rate = poisson_rate(wrong, n);
  return {{"wrong-codes",
           "wrong codes and places among all that was accepted above",
           "per 1000",
           accepted > 0 ? std::optional(1000 * static_cast<double>(wrong) / n) : std::nullopt,
           Interval{1000 * rate.low, 1000 * rate.high},
           accepted,
           {Goal::Sense::most, 0, 0, 3000, 10000},
           fmt::format("{} of {}", wrong, accepted)}};
}

}  // namespace

const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {"canvas", "every code before a plain grey", measure_canvas},
      {"clutter", "in clutter by length of the blur", measure_clutter},
      {"sizes", "in clutter, smaller ones too", measure_sizes},
      {"light", "in clutter, blurred as a camera does", measure_light},
      {"centre", "how exact the centre is", measure_centre},
      {"blur", "how exact the blur is", measure_blur},
      {"pose", "how exact the pose of one marker is, its size and the camera known", measure_pose},
      {"smallest", "how small a sharp marker may be", measure_smallest},
      {"tilt", "how far a sharp marker may be tilted", measure_tilt},
      {"contrast", "what a sheet that is not black costs", measure_contrast},
      {"violent", "bent blur and a rolling shutter", measure_violent},
      {"false-positives", "sightings where there is nothing", measure_false_positives},
      {"wrong-codes", "another code read than there is", measure_wrong_codes},
      {"time", "time of a picture beside aruco's", measure_times},
  };
  return all;
}

}  // namespace relock::bench
