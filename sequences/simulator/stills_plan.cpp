#include "sequences/simulator/stills_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>

#include "core/toml_table.h"
#include "sequences/description.h"

namespace relock::simulator {
namespace {

Range range(const TomlTable& table, std::string_view key, const Range& otherwise) {
  const toml::node* node = table.node(key);
  if (!node) return otherwise;
  if (const auto single = node->value<double>()) return {*single, *single};
  if (!node->is_array()) table.fail(*node, fmt::format("{} must be a number or a range: [low, high]", key));
  const std::vector<double> ends = table.numbers(key, {});
  if (ends.size() != 2) table.fail(*node, fmt::format("{} must be a range: [low, high]", key));
  return {ends[0], ends[1]};
}

/// Which of two words a key says.
template <class Choice>
Choice choice(const TomlTable& table, std::string_view key,
              std::array<std::pair<std::string_view, Choice>, 2> words, Choice otherwise) {
  const auto said = table.word(key);
  if (!said) return otherwise;
  for (const auto& [word, meant] : words)
    if (*said == word) return meant;
  table.fail(*table.node(key), fmt::format("{} must be one of {}, {}", key, words[0].first, words[1].first));
}

std::vector<std::string> targets(const TomlTable& table, std::vector<std::string> otherwise) {
  const auto nodes = table.list("targets");
  if (nodes.empty()) return otherwise;
  std::vector<std::string> names;
  for (const toml::node* node : nodes) {
    const auto name = node->value<std::string>();
    if (!name) table.fail(*node, "targets must be texts");
    names.push_back(*name);
  }
  return names;
}

std::string text(const Range& range) {
  return range.low == range.high ? fmt::format("{}", range.low)
                                 : fmt::format("[{}, {}]", range.low, range.high);
}

}  // namespace

bool is_stills_file(const std::filesystem::path& file) {
  return parse_toml(file)["preset"].value_or(std::string()) == "stills";
}

StillsFile read_stills_file(const std::filesystem::path& file) {
  const toml::table parsed = parse_toml(file);
  const TomlTable table(
      parsed, file.string(),
      {"preset", "targets", "seed", "stills", "width", "height", "focal_widths", "shown", "size_px",
       "tilt_deg", "turn_deg", "blurs_px", "noise", "black", "white", "backdrop", "grey", "blur_in"});
  StillsFile made;
  StillPlan& plan = made.plan;
  made.targets = targets(table, made.targets);
  const auto seed = table.value<std::int64_t>("seed", "a whole number");
  if (seed && *seed < 0) table.fail(*table.node("seed"), "seed must be a whole number from 0");
  if (seed) made.seed = static_cast<std::uint64_t>(*seed);
  made.stills = table.value<int>("stills", "a whole number").value_or(made.stills);
  plan.picture.width = table.value<int>("width", "a whole number").value_or(plan.picture.width);
  plan.picture.height = table.value<int>("height", "a whole number").value_or(plan.picture.height);
  plan.focal_widths = table.positive("focal_widths").value_or(plan.focal_widths);
  plan.shown = table.value<double>("shown", "a number").value_or(plan.shown);
  plan.size_px = range(table, "size_px", plan.size_px);
  plan.tilt_deg = range(table, "tilt_deg", plan.tilt_deg);
  plan.turn_deg = range(table, "turn_deg", plan.turn_deg);
  plan.blurs_px = table.numbers("blurs_px", plan.blurs_px);
  plan.noise = range(table, "noise", plan.noise);
  plan.black = range(table, "black", plan.black);
  plan.white = range(table, "white", plan.white);
  plan.backdrop = choice<Backdrop>(
      table, "backdrop", {{{"plain", Backdrop::plain}, {"clutter", Backdrop::clutter}}}, plan.backdrop);
  plan.grey = table.value<double>("grey", "a number").value_or(plan.grey);
  plan.blur_in =
      choice<BlurIn>(table, "blur_in", {{{"coded", BlurIn::coded}, {"light", BlurIn::light}}}, plan.blur_in);
  return made;
}

std::string stills_file_text(const StillsFile& stills) {
  const StillPlan& plan = stills.plan;
  std::vector<std::string> names;
  for (const std::string& name : stills.targets) names.push_back(toml_string(name));
  return fmt::format(
      "preset = \"stills\"\ntargets = [{}]\nseed = {}\nstills = {}\nwidth = {}\nheight = {}\nfocal_widths = "
      "{}\n"
      "shown = {}\nsize_px = {}\ntilt_deg = {}\nturn_deg = {}\nblurs_px = [{}]\nnoise = {}\nblack = "
      "{}\nwhite = {}\n"
      "backdrop = \"{}\"\ngrey = {}\nblur_in = \"{}\"\n",
      fmt::join(names, ", "), stills.seed, stills.stills, plan.picture.width, plan.picture.height,
      plan.focal_widths, plan.shown, text(plan.size_px), text(plan.tilt_deg), text(plan.turn_deg),
      fmt::join(plan.blurs_px, ", "), text(plan.noise), text(plan.black), text(plan.white),
      plan.backdrop == Backdrop::plain ? "plain" : "clutter", plan.grey,
      plan.blur_in == BlurIn::light ? "light" : "coded");
}

}  // namespace relock::simulator
