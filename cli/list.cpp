// `relock list`: the methods, with their options.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/catalogue.h"
#include "cli/combinations.h"
#include "cli/json_text.h"
#include "cli/verbs.h"

namespace relock {
namespace {

struct Row {
  std::string kind, name, sentence;
  std::vector<OptionInfo> options;
  std::string plugin = {};  // its file's name; empty: built in
};

std::string file_of(const std::optional<PluginFile>& plugin) { return plugin ? plugin->name : ""; }

std::vector<Row> rows(const Methods& methods) {
  std::vector<Row> all;
  for (const auto& d : methods.detectors.entries())
    all.push_back({"detector", d.name, d.sentence, d.options, file_of(d.plugin)});
  for (const auto& t : methods.trackers.entries()) {
    const bool yardstick = is_yardstick(t.name);
    const std::string sentence = t.sentence + (t.deterministic ? "" : " (answers differ from run to run)") +
                                 (t.needs.empty() ? "" : " (needs " + t.needs + ")");
    all.push_back({yardstick ? "yardstick" : "tracker", t.name, sentence, t.options, file_of(t.plugin)});
  }
  all.push_back({"yardstick", "mute", "never answers: the low end of every scale", {}});
  all.push_back({"yardstick", "oracle", "answers with the truth: the high end of every scale", {}});
  std::stable_sort(all.begin(), all.end(), [](const Row& a, const Row& b) {
    return (a.kind == "yardstick") < (b.kind == "yardstick");
  });
  for (const CombinationInfo& c : combinations())
    all.push_back({"combined", c.name, fmt::format("{} (of {})", c.sentence, c.takes), c.options});
  return all;
}

void print_json(const std::vector<Row>& all) {
  Json json = Json::array();
  for (const Row& row : all) {
    Json options = Json::array();
    for (const OptionInfo& o : row.options)
      options.push_back(
          {{"name", o.name}, {"default", o.default_value}, {"unit", o.unit}, {"sentence", o.sentence}});
    json.push_back({{"name", row.name},
                    {"kind", row.kind},
                    {"sentence", row.sentence},
                    {"options", options},
                    {"plugin", row.plugin.empty() ? Json() : Json(row.plugin)}});
  }
  fmt::print("{}", json_text(json));
}

}  // namespace

int list(const ListArguments& arguments, const Methods& methods) {
  const auto all = rows(methods);
  if (arguments.json) return print_json(all), 0;
  for (const Row& row : all) {
    fmt::print("{:<12} {:<9}  {}{}\n", row.name, row.kind, row.sentence,
               row.plugin.empty() ? "" : " (" + row.plugin + ")");
    if (!arguments.verbose) continue;
    for (const OptionInfo& option : row.options)
      fmt::print("{:>22}  {}={}{}\n{:24}{}\n", "", option.name, option.default_value,
                 option.unit.empty() ? "" : " " + option.unit, "", option.sentence);
  }
  if (!arguments.verbose)
    fmt::print(
        "\n`relock list --verbose` shows their options; give them as NAME(OPTION=VALUE,...), and the methods "
        "of a combination before them\n");
  return 0;
}

}  // namespace relock
