#include "cli/reproduce/localization.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/reproduce/canvas_run.h"
#include "cli/reproduce/paper.h"

namespace relock::reproduction {
namespace {

/// Blur of 30 to 65 px in steps of 5 at the angles of the paper's table.
CanvasExperiment localization_canvas(const Settings& settings) {
  CanvasExperiment experiment{"localization", {}, 12};
  experiment.plan.angles_deg.clear();
  for (const paper::CentreError& row : paper::centre_errors())
    experiment.plan.angles_deg.push_back(row.angle_deg);
  experiment.plan.lengths_px = {30, 50, 65};
  experiment.plan.repetitions = 1;
  if (settings.quick) return experiment;
  experiment.plan.lengths_px.clear();
  for (int blur = 30; blur <= 65; blur += 5) experiment.plan.lengths_px.push_back(blur);
  experiment.plan.repetitions = 4;
  return experiment;
}

/// What a method said of every code.
struct CodeAnswers {
  std::string code;
  std::vector<PictureAnswer> answers;
};
struct MethodAnswers {
  RingMethod method;
  std::vector<CodeAnswers> codes;
};

std::vector<MethodAnswers> answers_of(const CanvasExperiment& experiment, const Settings& settings,
                                      const Methods& methods) {
  std::vector<MethodAnswers> all;
  for (const RingMethod& method : ring_methods()) {
    if (!is_built_in(methods, method.method)) continue;
    MethodAnswers said{method, {}};
    std::vector<Contender> contenders;
    for (const std::string& code : ring_codes()) contenders.push_back({method.method, ring_target(code)});
    const auto results = run_canvas(experiment, contenders, settings, methods);
    for (std::size_t i = 0; i < results.size(); ++i)
      said.codes.push_back({ring_codes()[i], results[i].answers});
    all.push_back(std::move(said));
  }
  return all;
}

enum class Zeros { left_out, included };  // of the pictures of 00 from 50 px on

std::vector<PictureAnswer> chosen(const MethodAnswers& said, std::optional<double> angle_deg, Zeros zeros) {
  std::vector<PictureAnswer> some;
  for (const CodeAnswers& code : said.codes)
    for (const PictureAnswer& answer : code.answers) {
      if (angle_deg && answer.angle_deg != *angle_deg) continue;
      if (zeros == Zeros::left_out && code.code == "00" && answer.blur_px >= paper::kZerosLeftOutFrom_px)
        continue;
      some.push_back(answer);
    }
  return some;
}

std::string spread_text(std::optional<double> mean, std::optional<double> deviation) {
  if (!mean) return "n/a";
  return fmt::format("{:.2f} ± {}", *mean, cell(deviation, 2));
}

std::string mean_text(const CentreErrors& errors) {
  if (!errors.interval) return "n/a";
  return fmt::format("[{:.2f}, {:.2f}]", errors.interval->low, errors.interval->high);
}

std::vector<std::string> row_of(const std::string& first, const std::string& printed,
                                const MethodAnswers& said, std::optional<double> angle_deg) {
  const CentreErrors without = centre_errors(chosen(said, angle_deg, Zeros::left_out));
  const CentreErrors with = centre_errors(chosen(said, angle_deg, Zeros::included));
  return {first,
          printed,
          spread_text(without.mean_px, without.deviation_px),
          mean_text(without),
          fmt::format("{} of {}", without.recognised, without.pictures),
          cell(without.along_px, 2),
          cell(without.across_px, 2),
          spread_text(with.mean_px, with.deviation_px),
          fmt::format("{} of {}", with.recognised, with.pictures)};
}

Table table_of(const MethodAnswers& said) {
  Table table({said.method.note.empty() ? "angle, degrees" : "angle, " + said.method.note, "printed, px",
               "ours, px", "95 % of the mean", "found", "along", "across", "with all 00", "found"});
  for (const paper::CentreError& row : paper::centre_errors())
    table.add(row_of(fmt::format("{:g}", row.angle_deg),
                     fmt::format("{:.2f} ± {:.2f}", row.mean_px, row.deviation_px), said, row.angle_deg));
  table.add(row_of("all", "n/a", said, {}));
  return table;
}

Json json_of(const CentreErrors& errors) {
  return {{"pictures", errors.pictures},
          {"recognised", errors.recognised},
          {"mean_px", number(errors.mean_px)},
          {"deviation_px", number(errors.deviation_px)},
          {"interval_of_mean_px", interval(errors.interval)},
          {"along_px", number(errors.along_px)},
          {"across_px", number(errors.across_px)}};
}

Json json_of(const MethodAnswers& said) {
  Json angles = Json::array();
  for (const paper::CentreError& row : paper::centre_errors())
    angles.push_back({{"angle_deg", row.angle_deg},
                      {"as_printed", json_of(centre_errors(chosen(said, row.angle_deg, Zeros::left_out)))},
                      {"all", json_of(centre_errors(chosen(said, row.angle_deg, Zeros::included)))}});
  return {{"method", said.method.method}, {"note", said.method.note}, {"angles", angles}};
}

Json printed_json() {
  Json rows = Json::array();
  for (const paper::CentreError& row : paper::centre_errors())
    rows.push_back(
        {{"angle_deg", row.angle_deg}, {"mean_px", row.mean_px}, {"deviation_px", row.deviation_px}});
  return rows;
}

Plot plot_of(const std::vector<MethodAnswers>& all) {
  Plot plot{.title = "Table 1: error of the centre",
            .x = {.title = "angle of the blur, degrees"},
            .y = {.title = "mean error, px", .low = 0},
            .curves = {}};
  for (const MethodAnswers& said : all) {
    PlotCurve curve{.name = said.method.note.empty() ? said.method.method : said.method.note, .points = {}};
    for (const paper::CentreError& row : paper::centre_errors()) {
      const CentreErrors errors = centre_errors(chosen(said, row.angle_deg, Zeros::left_out));
      if (errors.mean_px) curve.points.push_back({row.angle_deg, *errors.mean_px, errors.interval});
    }
    plot.curves.push_back(std::move(curve));
  }
  PlotCurve printed{.name = "printed", .points = {}, .published = true};
  for (const paper::CentreError& row : paper::centre_errors())
    printed.points.push_back({row.angle_deg, row.mean_px});
  plot.curves.push_back(std::move(printed));
  return plot;
}

std::string departures(const MethodAnswers& said) {
  std::string smaller, larger;
  for (const paper::CentreError& row : paper::centre_errors()) {
    const CentreErrors errors = centre_errors(chosen(said, row.angle_deg, Zeros::left_out));
    if (!errors.interval) continue;
    std::string& where = errors.interval->high < row.mean_px ? smaller : larger;
    if (errors.interval->high < row.mean_px || errors.interval->low > row.mean_px)
      where += fmt::format("{}{:g}", where.empty() ? "" : ", ", row.angle_deg);
  }
  if (smaller.empty() && larger.empty())
    return fmt::format("{}: no printed mean is outside the interval of ours.", said.method.method);
  return fmt::format("{} departs from the printed means: {}{}{}.", said.method.method,
                     smaller.empty() ? "" : fmt::format("smaller at {} degrees", smaller),
                     smaller.empty() || larger.empty() ? "" : ", ",
                     larger.empty() ? "" : fmt::format("larger at {} degrees", larger));
}

}  // namespace

CentreErrors centre_errors(const std::vector<PictureAnswer>& answers) {
  CentreErrors errors;
  double sum = 0, along = 0, across = 0;
  std::vector<double> all;
  for (const PictureAnswer& answer : answers) {
    ++errors.pictures;
    if (!answer.recognised() || !answer.error_px) continue;
    all.push_back(*answer.error_px);
    sum += *answer.error_px;
    along += std::pow(answer.along_px.value_or(0), 2);
    across += std::pow(answer.across_px.value_or(0), 2);
  }
  errors.recognised = static_cast<int>(all.size());
  if (all.empty()) return errors;
  const double n = static_cast<double>(all.size()), mean = sum / n;
  errors.mean_px = mean;
  errors.along_px = std::sqrt(along / n);
  errors.across_px = std::sqrt(across / n);
  if (all.size() < 2) return errors;
  double squares = 0;
  for (const double error : all) squares += std::pow(error - mean, 2);
  errors.deviation_px = std::sqrt(squares / (n - 1));
  const double half = student_quantile(n - 1) * *errors.deviation_px / std::sqrt(n);
  errors.interval = Interval{mean - half, mean + half};
  return errors;
}

std::vector<Finding> table_1(const Settings& settings, const Methods& methods) {
  const CanvasExperiment experiment = localization_canvas(settings);
  const std::vector<MethodAnswers> all = answers_of(experiment, settings, methods);
  Finding finding;
  finding.id = "table-1";
  finding.title = "error of a ring's centre by angle of the blur, mean ± standard deviation";
  std::vector<std::string> asked;
  for (const RingMethod& method : ring_methods()) asked.push_back(method.method);
  finding.sentences = missing_methods(methods, asked);
  Json ours = Json::array();
  for (const MethodAnswers& said : all) {
    finding.tables.push_back(table_of(said));
    finding.sentences.push_back(departures(said));
    ours.push_back(json_of(said));
  }
  finding.sentences.push_back(fmt::format(
      "Over blur of {:g} px, {} codes; as in the paper without 00 from {:g} px on, and at the right "
      "with it. Brackets are 95 % of the mean, by Student's t over independent pictures; along and "
      "across the blur are RMS, px.",
      fmt::join(experiment.plan.lengths_px, ", "), ring_codes().size(), paper::kZerosLeftOutFrom_px));
  if (!all.empty())
    finding.sentences.push_back(
        "The paper does not say how the centre follows from a cluster; ring-paper takes that of the circle "
        "of the "
        "outermost ring.");
  if (!all.empty()) finding.plots = {plot_of(all)};
  finding.figures = {{"printed", printed_json()}, {"rings", ours}};
  return {finding};
}

}  // namespace relock::reproduction
