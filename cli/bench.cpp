// `relock bench`: is relock's own detector as good as it is meant to be?

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <opencv2/core/ocl.hpp>
#include <opencv2/core/utility.hpp>

#include "cli/bench/geometries.h"
#include "cli/bench/rows.h"
#include "cli/json_text.h"
#include "cli/table.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

using bench::Measured;

bench::Settings settings_of(const BenchArguments& a) {
  bench::Settings settings;
  const auto methods = parse_methods(a.method);
  if (methods.size() != 1) throw Error("--method takes one detector");
  settings.method = methods.front();
  settings.seeds = a.even_seeds ? bench::Seeds::even : bench::Seeds::odd;
  settings.pictures = a.pictures;
  settings.full = a.full;
  settings.jobs = a.jobs;
  return settings;
}

/// Those that were asked for, in the order of the table; all when none was.
std::vector<bench::Row> chosen_rows(const std::vector<std::string>& only) {
  std::vector<std::string> names;
  for (const bench::Row& row : bench::rows()) names.push_back(row.name);
  for (const std::string& name : only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(fmt::format("there is no row \"{}\"{}; there are {}", name, did_you_mean(name, names),
                              fmt::join(names, ", ")));
  std::vector<bench::Row> rows;
  for (const bench::Row& row : bench::rows())
    if (only.empty() || std::find(only.begin(), only.end(), row.name) != only.end()) rows.push_back(row);
  return rows;
}

std::string value_text(const Measured& m) {
  const int decimals = m.unit == "px" && m.row == "centre"                                             ? 3
                       : m.row == "blur" || m.row == "pose" || m.row == "time" || m.unit == "per 1000" ? 2
                                                                                                       : 1;
  std::string text = cell(m.value, decimals) + " " + m.unit;
  if (m.interval)
    text += fmt::format(" [{:.{}f}, {:.{}f}]", m.interval->low, decimals, m.interval->high, decimals);
  return text;
}

std::string goal_text(const std::optional<double>& goal) { return goal ? fmt::format("{:g}", *goal) : "n/a"; }

std::string text_of(const std::vector<Measured>& all, const bench::Settings& settings) {
  Table table({"what", "measured", "must", "aim", "verdict", "pictures"});
  std::string details;
  for (const Measured& m : all) {
    table.add({m.what, value_text(m), goal_text(m.goal.must), goal_text(m.goal.aim), verdict_of(m),
               fmt::format("{}", m.pictures)});
    if (!m.detail.empty()) details += fmt::format("  {}: {}\n", m.what, m.detail);
  }
  return fmt::format(
      "{} on simulated pictures from {}{}\n\n{}\n{}  Brackets are of 95 %. A verdict with a question mark "
      "could be the other one by chance.\n",
      settings.method.text(),
      settings.seeds == bench::Seeds::odd
          ? "odd seeds, which it was not tuned on (it was on even ones)"
          : "even seeds: those it was tuned on, no evidence of how good it is",
      settings.full ? "" : "; a small sample (--full looks at more)", table.text(2), details);
}

Json json_of(const std::vector<Measured>& all, const bench::Settings& settings) {
  Json lines = Json::array();
  for (const Measured& m : all)
    lines.push_back({{"row", m.row},
                     {"what", m.what},
                     {"unit", m.unit},
                     {"value", number(m.value)},
                     {"interval", interval(m.interval)},
                     {"pictures", m.pictures},
                     {"must", number(m.goal.must)},
                     {"aim", number(m.goal.aim)},
                     {"verdict", verdict_of(m)},
                     {"detail", m.detail}});
  return {{"method", settings.method.text()},
          {"seeds", settings.seeds == bench::Seeds::odd ? "odd" : "even"},
          {"full", settings.full},
          {"lines", lines}};
}

}  // namespace

int bench_detector(const BenchArguments& arguments, const Methods& methods) {
  cv::setNumThreads(1);  // pictures are looked at in parallel, not their parts
  cv::ocl::setUseOpenCL(false);
  const bench::Settings settings = settings_of(arguments);
  if (arguments.geometries) {
    const auto all = bench::measure_geometries(settings, methods);
    fmt::print("{}", arguments.json ? json_text(bench::json_of(all)) : bench::text_of(all));
    return 0;
  }
  const auto rows = chosen_rows(arguments.only);
  bench::Bench bench(settings, methods);
  std::vector<Measured> all;
  for (const bench::Row& row : rows)
    for (Measured& measured : row.measure(bench)) all.push_back(std::move(measured));
  fmt::print("{}", arguments.json ? json_text(json_of(all, settings)) : text_of(all, settings));
  return 0;
}

}  // namespace relock
