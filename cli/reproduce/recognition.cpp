#include "cli/reproduce/recognition.h"

#include <fmt/format.h>

#include "cli/reproduce/canvas_run.h"
#include "cli/reproduce/paper.h"
#include "cli/reproduce/rates.h"

namespace relock::reproduction {
namespace {

/// Blur of 15 to 80 px in steps of 5, at 0, 10, …, 350 degrees: every line twice, with another place and other noise.
CanvasExperiment recognition_canvas(const Settings& settings) {
  CanvasExperiment experiment{"recognition", {}, 11};
  experiment.plan.lengths_px = {30, 50, 65};
  experiment.plan.angles_deg = {0, 30, 60, 90, 120, 150};
  if (settings.quick) return experiment;
  experiment.plan.lengths_px.clear();
  experiment.plan.angles_deg.clear();
  for (int blur = 15; blur <= 80; blur += 5) experiment.plan.lengths_px.push_back(blur);
  for (int angle = 0; angle < 360; angle += 10) experiment.plan.angles_deg.push_back(angle);
  return experiment;
}

std::string pictures_sentence(const CanvasExperiment& experiment) {
  return fmt::format(
      "Each rate is of {} independent pictures, at as many angles of the blur; brackets are Wilson's 95 %.",
      experiment.plan.angles_deg.size() * static_cast<std::size_t>(experiment.plan.repetitions));
}

struct MarkerRates {
  Contender contender;
  std::vector<Rate> rates;
};

std::vector<MarkerRates> rates_of(const CanvasExperiment& experiment,
                                  const std::vector<Contender>& contenders, const Settings& settings,
                                  const Methods& methods) {
  std::vector<MarkerRates> all;
  for (const CanvasResult& result : run_canvas(experiment, contenders, settings, methods))
    all.push_back({result.contender, rates_by_blur(result.answers)});
  return all;
}

std::vector<std::string> blur_header(const std::string& first, const std::vector<double>& lengths) {
  std::vector<std::string> header{first};
  for (const double length : lengths) header.push_back(fmt::format("{:g}", length));
  return header;
}

std::vector<std::string> printed_row(const paper::PublishedRates& published,
                                     const std::vector<double>& lengths) {
  std::vector<std::string> row{fmt::format("{}, printed", published.name)};
  for (const double length : lengths) row.push_back(cell(published.at(length), 0));
  return row;
}

/// Of the lengths that figure 3 prints, those that were tried.
std::vector<double> lengths_of_figure_3(const CanvasExperiment& experiment) {
  std::vector<double> lengths;
  for (const double length : experiment.plan.lengths_px)
    if (paper::artag().at(length)) lengths.push_back(length);
  return lengths;
}

Json json_of(const paper::PublishedRates& published) {
  Json rates = Json::array();
  for (const paper::RateAtBlur& rate : published.rates)
    rates.push_back({{"blur_px", rate.blur_px}, {"percent", rate.percent}});
  return {{"marker", std::string(published.name)}, {"rates", rates}};
}

Json json_of(const std::vector<MarkerRates>& markers) {
  Json all = Json::array();
  for (const MarkerRates& marker : markers)
    all.push_back({{"method", marker.contender.method},
                   {"target", marker.contender.target},
                   {"rates", reproduction::json_of(marker.rates)}});
  return all;
}

void add(std::vector<std::string>& sentences, const std::vector<std::string>& more) {
  sentences.insert(sentences.end(), more.begin(), more.end());
}

/// Rings of one method, by code.
struct RingRates {
  RingMethod method;
  std::vector<MarkerRates> codes;  ///< in the order of ring_codes()

  std::string name(std::size_t code) const {
    return method.note.empty() ? ring_codes()[code] : fmt::format("{}, {}", ring_codes()[code], method.note);
  }
};

std::vector<RingRates> ring_rates(const CanvasExperiment& experiment, const Settings& settings,
                                  const Methods& methods) {
  std::vector<RingRates> all;
  for (const RingMethod& method : ring_methods()) {
    if (!is_built_in(methods, method.method)) continue;
    all.push_back({method, rates_of(experiment, contenders_of(method), settings, methods)});
  }
  return all;
}

/// relock's own detector of rings, by code; none where it is not built in.
std::vector<MarkerRates> own_rings(const CanvasExperiment& experiment, const Settings& settings,
                                   const Methods& methods) {
  if (!is_built_in(methods, own_ring_method().method)) return {};
  return rates_of(experiment, contenders_of(own_ring_method()), settings, methods);
}

/// Figure 3: the paper's square markers, today's, and rings.
Table table_of_squares(const std::vector<MarkerRates>& squares, const std::vector<MarkerRates>& rings,
                       const std::vector<double>& lengths) {
  Table table(blur_header("marker \\ blur, px", lengths));
  for (const auto* published : {&paper::pitag(), &paper::artag()})
    table.add(printed_row(*published, lengths));
  for (const auto* markers : {&squares, &rings})
    for (const MarkerRates& marker : *markers) {
      std::vector<std::string> row{marker.contender.target};
      for (const double length : lengths) row.push_back(rate_text(rate_at(marker.rates, length)));
      table.add(row);
    }
  return table;
}

/// The paper's rates beside ours, with intervals.
Table table_of_rings(const RingRates& rings, const std::vector<double>& lengths) {
  std::vector<std::string> header{"blur, px"};
  for (std::size_t code = 0; code < rings.codes.size(); ++code) {
    header.push_back(rings.name(code));
    header.push_back("printed");
  }
  Table table(header);
  for (const double length : lengths) {
    std::vector<std::string> row{fmt::format("{:g}", length)};
    for (std::size_t code = 0; code < rings.codes.size(); ++code) {
      row.push_back(rate_text(rate_at(rings.codes[code].rates, length)));
      row.push_back(cell(paper::ring(ring_codes()[code]).at(length), 0));
    }
    table.add(row);
  }
  return table;
}

/// Everybody on one canvas: rates alone, or the lines would be too long.
Table table_of_all(const std::vector<RingRates>& rings, const std::vector<MarkerRates>& squares,
                   const std::vector<double>& lengths) {
  Table table(blur_header("marker \\ blur, px", lengths));
  const auto add_row = [&](const std::string& name, const std::vector<Rate>& rates) {
    std::vector<std::string> row{name};
    for (const double length : lengths) {
      const auto rate = rate_at(rates, length);
      row.push_back(cell(rate ? std::optional(rate->percent()) : std::nullopt, 0));
    }
    table.add(row);
  };
  for (const RingRates& ring : rings)
    for (std::size_t code = 0; code < ring.codes.size(); ++code)
      add_row("ring:" + ring.name(code), ring.codes[code].rates);
  for (const std::string& code : ring_codes()) {
    auto row = printed_row(paper::ring(code), lengths);
    row.front() = "ring:" + row.front();
    table.add(row);
  }
  for (const MarkerRates& square : squares) add_row(square.contender.target, square.rates);
  for (const auto* published : {&paper::pitag(), &paper::artag()})
    table.add(printed_row(*published, lengths));
  return table;
}

Plot plot_of(const std::string& title) {
  return {.title = title,
          .x = {.title = "length of the blur, px"},
          .y = {.title = "recognised, %", .low = 0, .high = 100},
          .curves = {}};
}

/// The markers that are in most use, so that the curves can be told apart.
bool customary(const std::string& target) {
  return target.starts_with("arucooriginal:") || target.starts_with("aruco6x6_250:") ||
         target.starts_with("apriltag36h11:");
}

/// One for each way to look for rings: there are no more colours.
Plot plot_of_rings(const RingRates& rings, const std::vector<MarkerRates>& squares) {
  Plot plot = plot_of(fmt::format("Figure 11: rings by code ({}), and square markers", rings.method.method));
  plot.width_mm = 160, plot.height_mm = 120;
  for (std::size_t code = 0; code < rings.codes.size(); ++code)
    plot.curves.push_back(curve_of("ring " + rings.name(code), rings.codes[code].rates));
  for (const MarkerRates& square : squares)
    if (customary(square.contender.target))
      plot.curves.push_back(curve_of(square.contender.target, square.rates));
  plot.curves.push_back(curve_of("01, 10, 11, printed", paper::ring("01")));
  plot.curves.push_back(curve_of("00, printed", paper::ring("00")));
  plot.curves.push_back(curve_of("ARTag, printed", paper::artag()));
  plot.curves.push_back(curve_of("PiTag, printed", paper::pitag()));
  return plot;
}

Plot plot_of_squares(const std::string& title, const std::vector<MarkerRates>& squares) {
  Plot plot = plot_of(title);
  plot.width_mm = 160, plot.height_mm = 120;
  for (const MarkerRates& square : squares)
    plot.curves.push_back(curve_of(square.contender.target, square.rates));
  plot.curves.push_back(curve_of("ARTag, printed", paper::artag()));
  plot.curves.push_back(curve_of("PiTag, printed", paper::pitag()));
  return plot;
}

int wrong_codes(const std::vector<MarkerRates>& markers) {
  int wrong = 0;
  for (const MarkerRates& marker : markers)
    for (const Rate& rate : marker.rates) wrong += rate.wrong_code;
  return wrong;
}

std::vector<std::string> ring_sentences(const std::vector<RingRates>& rings) {
  std::vector<std::string> sentences;
  bool departs = false;
  for (const RingRates& ring : rings) {
    for (std::size_t code = 0; code < ring.codes.size(); ++code) {
      const auto sentence =
          departures("ring:" + ring.name(code), ring.codes[code].rates, paper::ring(ring_codes()[code]));
      if (sentence) sentences.push_back(*sentence);
      departs |= sentence.has_value();
    }
    sentences.push_back(fmt::format("{}: {} pictures were read as another code.", ring.method.method,
                                    wrong_codes(ring.codes)));
    if (!ring.method.reason.empty()) sentences.push_back(ring.method.reason);
  }
  if (departs)
    sentences.push_back(
        "The printed rates are not those of the authors' released program, either. Run on such a canvas, all "
        "codes "
        "together, it reads 100 % of rings of 150 px at 30 px of blur, 90 to 94 % from 35 to 65 px and 32 % "
        "at 80; of "
        "rings of 100 px 100 % up to 45 px, 92 % at 50 and 33 % at 65.");
  return sentences;
}

}  // namespace

std::vector<Finding> figure_3(const Settings& settings, const Methods& methods) {
  const CanvasExperiment experiment = recognition_canvas(settings);
  const auto squares = rates_of(experiment, squares_built_in(methods), settings, methods);
  const auto rings = own_rings(experiment, settings, methods);

  Finding finding;
  finding.id = "figure-3";
  finding.title = "square markers and the ring of 150 px under motion blur, % recognised";
  finding.tables = {table_of_squares(squares, rings, lengths_of_figure_3(experiment))};
  std::vector<std::string> asked = methods_of(square_markers());
  add(asked, {own_ring_method().method});
  finding.sentences = missing_methods(methods, asked);
  finding.sentences.push_back(pictures_sentence(experiment));
  finding.sentences.push_back(
      "PiTag and ARTag themselves are not here: the markers below them stand for what is in use today, each "
      "grid of cells once. Of ARTag's kind, found by the edges of a black square, are all the square ones.");
  if (!rings.empty()) finding.sentences.push_back(own_ring_method().reason);
  finding.plots = {plot_of_squares("Figure 3: square markers", squares)};
  finding.figures = {{"printed", Json::array({json_of(paper::pitag()), json_of(paper::artag())})},
                     {"markers", json_of(squares)},
                     {"rings", json_of(rings)}};
  return {finding};
}

std::vector<Finding> figure_11(const Settings& settings, const Methods& methods) {
  const CanvasExperiment experiment = recognition_canvas(settings);
  const auto rings = ring_rates(experiment, settings, methods);
  const auto squares = rates_of(experiment, squares_built_in(methods), settings, methods);

  Finding finding;
  finding.id = "figure-11";
  finding.title = "rings by code beside square markers under motion blur, % recognised";
  for (const RingRates& ring : rings)
    finding.tables.push_back(table_of_rings(ring, experiment.plan.lengths_px));
  finding.tables.push_back(table_of_all(rings, squares, experiment.plan.lengths_px));
  std::vector<std::string> asked = methods_of(square_markers());
  add(asked, methods_of(ring_methods()));
  finding.sentences = missing_methods(methods, asked);
  finding.sentences.push_back(pictures_sentence(experiment));
  add(finding.sentences, ring_sentences(rings));
  for (const RingRates& ring : rings) finding.plots.push_back(plot_of_rings(ring, squares));
  if (rings.empty()) finding.plots.push_back(plot_of_squares("Figure 11: square markers", squares));

  Json ours = Json::array(), printed = Json::array();
  for (const RingRates& ring : rings)
    ours.push_back(
        {{"method", ring.method.method}, {"note", ring.method.note}, {"codes", json_of(ring.codes)}});
  for (const std::string& code : ring_codes()) printed.push_back(json_of(paper::ring(code)));
  finding.figures = {{"printed", printed}, {"rings", ours}, {"squares", json_of(squares)}};
  return {finding};
}

}  // namespace relock::reproduction
