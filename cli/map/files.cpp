// map.csv and map.json.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/json_text.h"
#include "cli/map/answer.h"
#include "cli/version.h"
#include "core/csv.h"

namespace relock::maps {
namespace {

constexpr double kLeastShare = 0, kLeastDifference = -1;

double rounded(double value, double digits) { return std::round(value * digits) / digits; }

/// Empty, or null, where it is not known.
std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.6f}", value) : ""; }
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : ""; }
Json number(double value) { return std::isfinite(value) ? Json(rounded(value, 1e6)) : Json(nullptr); }

std::string place_cells(const MeasuredMap& map, std::size_t row, std::size_t column) {
  const auto blur = [](double value) { return std::isfinite(value) ? fmt::format("{:.4f}", value) : ""; };
  return fmt::format("{:g},{},{},{:g}", map.plan.exposures_ms[row], blur(map.blur[row].mean_px),
                     blur(map.blur[row].mean_percent), map.plan.columns[column]);
}

/// As far as it is between two limits that the number itself has.
Interval as_far_as(const Interval& interval, double least, double most) {
  return {std::clamp(interval.low, least, most), std::clamp(interval.high, least, most)};
}

std::string estimate_cells(const Estimate& estimate, double least) {
  if (!estimate.value) return ",,";
  const Interval interval = as_far_as(estimate.interval(), least, 1);
  return fmt::format("{},{},{}", cell(*estimate.value), cell(interval.low), cell(interval.high));
}

const char* word(Ahead ahead) {
  return ahead == Ahead::tracking ? "tracking" : ahead == Ahead::detection ? "detection" : "undecided";
}
/// Nothing where there is no difference.
const char* word(const Estimate& difference) { return difference.value ? word(ahead(difference)) : ""; }

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

Json estimate_json(const Estimate& estimate, double least) {
  if (!estimate.value) return {{"value", nullptr}, {"low", nullptr}, {"high", nullptr}};
  const Interval interval = as_far_as(estimate.interval(), least, 1);
  return {{"value", number(*estimate.value)}, {"low", number(interval.low)}, {"high", number(interval.high)}};
}

Json optional_json(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json boundary_json(const MeasuredMap& map, const Answer& answer, std::size_t row) {
  const RowAnswer& found = answer.rows[row];
  Json json{{"exposure_ms", map.plan.exposures_ms[row]}};
  if (found.boundary) {
    json["at"] = number(found.boundary->at);
    json["low"] = optional_json(found.boundary->low);
    json["high"] = optional_json(found.boundary->high);
    json["ahead_below"] = word(found.boundary->before);
  } else {
    json["at"] = nullptr;
    json["ahead"] = word(found.leads);
  }
  return json;
}

Json rows_json(const MeasuredMap& map) {
  Json rows = Json::array();
  for (std::size_t row = 0; row < map.blur.size(); ++row)
    rows.push_back({{"exposure_ms", map.plan.exposures_ms[row]},
                    {"blur_px", number(map.blur[row].mean_px)},
                    {"blur_percent", number(map.blur[row].mean_percent)}});
  return rows;
}

Json method_json(const MeasuredMap& map, std::size_t m) {
  const MethodMap& method = map.methods[m];
  Json cells = Json::array();
  for (std::size_t row = 0; row < method.cells.size(); ++row) {
    Json line = Json::array();
    for (std::size_t column = 0; column < method.cells[row].size(); ++column) {
      Json json = estimate_json(locked_share(method.cells[row][column]), kLeastShare);
      json["ceiling"] = optional_json(map.ceilings[m][row][column]);
      line.push_back(std::move(json));
    }
    cells.push_back(std::move(line));
  }
  return {{"name", method.name}, {"class", to_string(method.kind)}, {"locked_share", std::move(cells)}};
}

}  // namespace

std::string csv_of(const MeasuredMap& map, const Answer& answer) {
  std::string text = fmt::format(
      "exposure_ms,blur_px,blur_percent,{},method,class,locked_share,low,high,ceiling,"
      "locked_s,visible_s,seeds,ahead\n",
      map.plan.across == Across::gap    ? "gap_slots"
      : map.plan.across == Across::rate ? "rate_hz"
                                        : "size_px");
  for (std::size_t row = 0; row < map.blur.size(); ++row) {
    for (std::size_t column = 0; column < map.plan.columns.size(); ++column) {
      const std::string place = place_cells(map, row, column);
      for (std::size_t m = 0; m < map.methods.size(); ++m) {
        const MethodMap& method = map.methods[m];
        const LockedTime& time = method.cells[row][column];
        text += fmt::format("{},{},{},{},{},{:.6f},{:.6f},{},\n", place, csv_cell(method.name),
                            to_string(method.kind), estimate_cells(locked_share(time), kLeastShare),
                            cell(map.ceilings[m][row][column]), total(time.locked_s), total(time.visible_s),
                            map.plan.seeds);
      }
      const Estimate& difference = answer.difference[row][column];
      text += fmt::format("{},{},difference,{},,,,{},{}\n", place,
                          csv_cell(answer.tracker + " - " + answer.detector),
                          estimate_cells(difference, kLeastDifference), map.plan.seeds, word(difference));
    }
  }
  return text;
}

std::string json_of(const MeasuredMap& map, const Answer& answer) {
  Json json{{"relock", kVersion},
            {"axes", fmt::format("{},blur", to_string(map.plan.across))},
            {"columns", map.plan.columns},
            {"columns_are", title_of_columns(map.plan.across)},
            {"rows", rows_json(map)},
            {"seeds", map.plan.seeds},
            {"gates", "centre 0.25 D, hold 0.5 D"},
            {"protocol", "once"}};
  if (map.plan.across == Across::gap) json["gap_share"] = map.plan.gap_share;
  Json methods = Json::array(), difference = Json::array(), boundaries = Json::array();
  for (std::size_t m = 0; m < map.methods.size(); ++m) methods.push_back(method_json(map, m));
  for (std::size_t row = 0; row < map.blur.size(); ++row) {
    Json line = Json::array();
    for (const Estimate& cell : answer.difference[row]) {
      line.push_back(estimate_json(cell, kLeastDifference));
      line.back()["ahead"] = cell.value ? Json(word(cell)) : Json(nullptr);
    }
    difference.push_back(std::move(line));
    boundaries.push_back(boundary_json(map, answer, row));
  }
  json["methods"] = std::move(methods);
  json["tracker"] = answer.tracker;
  json["detector"] = answer.detector;
  json["difference"] = std::move(difference);
  json["boundaries"] = std::move(boundaries);
  json["flight"] = simulator::flight_plan_text(map.plan.flight);
  return json_text(json);
}

}  // namespace relock::maps
