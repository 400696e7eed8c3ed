#include "cli/map/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/table.h"
#include "core/error.h"

namespace relock::maps {
namespace {

/// The method of this name, or the best of its class.
const MethodMap& contender(const MeasuredMap& map, const std::optional<std::string>& name, MethodClass kind) {
  if (!name) {
    if (const MethodMap* best = best_of(map.methods, kind)) return *best;
    throw Error(
        fmt::format("a map needs a tracker and a detector, and --methods names no {}", to_string(kind)));
  }
  for (const MethodMap& method : map.methods)
    if (method.name == *name && method.kind == kind) return method;
  throw Error(fmt::format("--{0} {1}: the map has no {0} of this name; it must be one of --methods",
                          to_string(kind), *name));
}

RowAnswer row_answer(const std::vector<double>& axis, const std::vector<Estimate>& differences) {
  RowAnswer row{boundary_of(axis, differences), Ahead::undecided};
  if (row.boundary) return row;
  bool tracking = false, detection = false;
  for (const Estimate& difference : differences) {
    tracking |= ahead(difference) == Ahead::tracking;
    detection |= ahead(difference) == Ahead::detection;
  }
  if (tracking != detection) row.leads = tracking ? Ahead::tracking : Ahead::detection;
  return row;
}

const char* letter(const Estimate& difference) {
  if (!difference.value) return "n/a";
  const Ahead side = ahead(difference);
  return side == Ahead::tracking ? "T" : side == Ahead::detection ? "D" : "·";
}

/// Places on the axis with their unit: "gaps of 3.4 slots".
std::string places(Across across, const std::string& values) {
  switch (across) {
    case Across::gap:
      return fmt::format("gaps of {} slots", values);
    case Across::rate:
      return fmt::format("{} Hz", values);
    case Across::size:
      break;
  }
  return fmt::format("{} px", values);
}

std::string one_decimal(double value) { return fmt::format("{:.1f}", value); }

/// "tracking (kcf) beats detection (aruco) up to gaps of 3.4 slots [2.1, 5.0], and beyond it is the other way
/// round"; only what is beyond doubt is said to beat.
std::string boundary_sentence(Across across, const Boundary& boundary, const std::string& first,
                              const std::string& second) {
  const std::string low = boundary.low ? one_decimal(*boundary.low) : "below the map";
  const std::string high = boundary.high ? one_decimal(*boundary.high) : "beyond the map";
  const std::string at = fmt::format("{} [{}, {}]", places(across, one_decimal(boundary.at)), low, high);
  if (!boundary.high)
    return fmt::format("{} beats {} up to {}; the lead changes at {}", first, second, places(across, low),
                       at);
  if (!boundary.low)
    return fmt::format("{} beats {} from {} on; the lead changes at {}", second, first, places(across, high),
                       at);
  return fmt::format("{} beats {} up to {}, and beyond it is the other way round", first, second, at);
}

std::string blur_text(const MeasuredMap& map, std::size_t row) {
  if (!std::isfinite(blur_of_row(map, row))) return "n/a";
  return map.plan.across == Across::size ? fmt::format("{:.1f} px", map.blur[row].mean_px)
                                         : fmt::format("{:.0f} % of D", map.blur[row].mean_percent);
}

/// Columns at which a side is ahead beyond doubt: "1, 2, 4".
std::string decided_columns(const MeasuredMap& map, const std::vector<Estimate>& differences, Ahead side) {
  std::string text;
  for (std::size_t column = 0; column < differences.size(); ++column)
    if (ahead(differences[column]) == side)
      text += fmt::format("{}{:g}", text.empty() ? "" : ", ", map.plan.columns[column]);
  return text;
}

std::string row_sentence(const MeasuredMap& map, const Answer& answer, std::size_t row) {
  const RowAnswer& found = answer.rows[row];
  const std::string tracking = fmt::format("tracking ({})", answer.tracker);
  const std::string detection = fmt::format("detection ({})", answer.detector);
  const std::string blur = blur_text(map, row);
  if (std::none_of(answer.difference[row].begin(), answer.difference[row].end(),
                   [](const Estimate& difference) { return difference.value.has_value(); }))
    return fmt::format("blur {}: n/a, the target is never visible", blur);
  if (found.boundary) {
    const bool tracking_first = found.boundary->before == Ahead::tracking;
    return fmt::format(
        "blur {}: {}", blur,
        boundary_sentence(map.plan.across, *found.boundary, tracking_first ? tracking : detection,
                          tracking_first ? detection : tracking));
  }
  if (found.leads == Ahead::undecided)
    return fmt::format("blur {}: no boundary within the map, and nobody is ahead beyond doubt", blur);
  const bool tracking_leads = found.leads == Ahead::tracking;
  return fmt::format("blur {}: no boundary within the map; {} beats {} at {}", blur,
                     tracking_leads ? tracking : detection, tracking_leads ? detection : tracking,
                     places(map.plan.across, decided_columns(map, answer.difference[row], found.leads)));
}

}  // namespace

Answer answer(const MeasuredMap& map, const std::optional<std::string>& tracker,
              const std::optional<std::string>& detector) {
  const MethodMap& tracking = contender(map, tracker, MethodClass::tracker);
  const MethodMap& detection = contender(map, detector, MethodClass::detector);
  Answer result{tracking.name,
                detection.name,
                tracker.has_value(),
                detector.has_value(),
                differences(tracking, detection),
                {}};
  for (const auto& row : result.difference) result.rows.push_back(row_answer(map.plan.columns, row));
  return result;
}

std::string title_of_columns(Across across) {
  switch (across) {
    case Across::gap:
      return "gap, slots";
    case Across::rate:
      return "frame rate, Hz";
    case Across::size:
      break;
  }
  return "target size D, px";
}

std::string title_of_rows(Across across) {
  return across == Across::size ? "mean blur, px" : "mean blur, % of D";
}

double blur_of_row(const MeasuredMap& map, std::size_t row) {
  return map.plan.across == Across::size ? map.blur[row].mean_px : map.blur[row].mean_percent;
}

std::string blur_cell(const MeasuredMap& map, std::size_t row) {
  const double blur = blur_of_row(map, row);
  return std::isfinite(blur) ? one_decimal(blur) : "n/a";
}

std::string text_of(const MeasuredMap& map, const Answer& answer) {
  const SweepPlan& plan = map.plan;
  std::string text = fmt::format(
      "Who has the target for longer: T tracking ({}), D detection ({}), · undecided; {} seeds of {:g} s\n\n",
      answer.tracker, answer.detector, plan.seeds, plan.flight.duration_s);
  std::vector<std::string> header{
      fmt::format("{} \\ {}", title_of_rows(plan.across), title_of_columns(plan.across))};
  for (const double column : plan.columns) header.push_back(fmt::format("{:g}", column));
  Table letters(header);
  for (std::size_t row = map.blur.size(); row-- > 0;) {
    std::vector<std::string> line{blur_cell(map, row)};
    for (const Estimate& difference : answer.difference[row]) line.push_back(letter(difference));
    letters.add(line);
  }
  text += letters.text(2) + "\n";
  for (std::size_t row = map.blur.size(); row-- > 0;) text += "  " + row_sentence(map, answer, row) + "\n";
  if (plan.across == Across::gap)
    text +=
        fmt::format("\n  {:g} % of the intervals are gaps; a gap of 1 slot is none.", 100 * plan.gap_share);
  return text + "\n  Brackets: 95 % over seeds, as the cells' (docs/map.md).\n";
}

}  // namespace relock::maps
