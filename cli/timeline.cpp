// `relock timeline`: what became of every target, as a lane and a sentence, or as a figure for a paper.

#include <fmt/format.h>

#include <algorithm>

#include "cli/chosen_methods.h"
#include "cli/chosen_target.h"
#include "cli/comparison.h"
#include "cli/readable.h"
#include "cli/terminal.h"
#include "cli/timeline_figure.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "eval/timeline_text.h"

namespace relock {
namespace {

struct Line {
  std::string name, lane, story;
};

/// Lane and sentence side by side where the terminal is wide enough, else one below the other.
void print_line(const Line& line, std::size_t name_columns, const TimelineStyle& style, int width) {
  const std::string name = padded(line.name, name_columns);
  const auto lane_columns = static_cast<std::size_t>(style.columns);
  const bool fits =
      name_columns + lane_columns + columns_of(line.story) + 6 <= static_cast<std::size_t>(width);
  if (fits) {
    fmt::print("  {}  {}  {}\n", name, line.lane, line.story);
  } else {
    fmt::print("  {}  {}\n  {:{}}  {}\n", name, line.lane, "", name_columns, line.story);
  }
}

void print_target(const ScoredComparison& scored, const std::vector<std::size_t>& runs, std::size_t t,
                  TimelineStyle style, int width) {
  const StoredComparison& comparison = scored.stored;
  const auto& evaluations = scored.evaluations;
  const Recording& recording = comparison.recording;
  std::vector<Line> lines;
  std::size_t name_columns = 0;
  for (const std::size_t i : runs)
    name_columns = std::max(name_columns, columns_of(comparison.runs[i].record.method));
  style.columns = std::clamp(width - static_cast<int>(name_columns) - 4, 20, 100);
  for (const std::size_t i : runs) {
    const StoredRun& run = comparison.runs[i];
    if (!run.trajectory.judged_from[t]) continue;
    lines.push_back({run.record.method, lane(recording, evaluations[i].targets[t], style),
                     story(recording, run.trajectory, evaluations[i], t)});
  }
  if (lines.empty()) return;
  const std::string marks = ruler(recording, style);
  const auto shown =
      static_cast<int>(columns_of(lane(recording, evaluations[0].targets[t], {style.columns})));
  style.columns = shown;
  const Target& target = recording.targets[t];
  fmt::print("\n  target {}{}\n", target.id,
             target.code ? fmt::format(" ({})", to_string(*target.code)) : "");
  for (const Line& line : lines) print_line(line, name_columns, style, width);
  fmt::print("  {:{}}  {}\n", "", name_columns, marks);
}

void print_all(std::vector<StoredComparison> all, const TimelineArguments& arguments) {
  const Terminal out = terminal(stdout);
  const TimelineStyle style{60, out.unicode && !arguments.ascii, out.colour && !arguments.ascii};
  bool first = true;
  check_target(all, arguments.target);
  check_methods(all, arguments.methods);
  for (StoredComparison& stored : all) {
    const Gate gate = gate_of(stored, arguments.gate);
    const ScoredComparison compared = scored(std::move(stored), gate);
    const auto& targets = compared.stored.recording.targets;
    const auto shown = [&](const Target& target) { return wanted(target, arguments.target); };
    const auto runs = chosen_runs(compared.stored, arguments.methods, Yardsticks::too);
    if (std::none_of(targets.begin(), targets.end(), shown) || runs.empty()) continue;
    fmt::print("{}{}\n", first ? "" : "\n", heading(compared.stored, gate));
    first = false;
    for (std::size_t t = 0; t < targets.size(); ++t)
      if (shown(targets[t])) print_target(compared, runs, t, style, out.width);
    if (const auto end = end_of_recording(compared.stored)) fmt::print("  {}\n", *end);
  }
  fmt::print("\n  {}\n", legend(style));
}

// Figures

bool wants_figure(const TimelineArguments& arguments) {
  return arguments.svg || arguments.pdf || arguments.png;
}

void check_figure(const TimelineArguments& arguments) {
  const auto check = [](const std::optional<std::filesystem::path>& file, const std::string& ending) {
    if (file && file->extension() != ending)
      throw Error(
          fmt::format("--{} writes {}, and {} does not end so", ending.substr(1), ending, file->string()));
  };
  check(arguments.svg, ".svg");
  check(arguments.pdf, ".pdf");
  check(arguments.png, ".png");
  if (!wants_figure(arguments) && (arguments.width_mm || arguments.height_mm))
    throw Error("--width-mm and --height-mm are of a figure; give --svg, --pdf or --png, too");
}

void draw_all(std::vector<StoredComparison> all, const TimelineArguments& arguments) {
  check_target(all, arguments.target);
  check_methods(all, arguments.methods);
  StoredComparison stored = only_one(std::move(all), "a figure");
  const Gate gate = gate_of(stored, arguments.gate);
  const ScoredComparison compared = scored(std::move(stored), gate);
  std::vector<std::size_t> targets;
  for (std::size_t t = 0; t < compared.stored.recording.targets.size(); ++t)
    if (wanted(compared.stored.recording.targets[t], arguments.target)) targets.push_back(t);
  LanePlot plot = timeline_figure(
      compared, chosen_runs(compared.stored, arguments.methods, Yardsticks::if_alone), targets);
  plot.width_mm = arguments.width_mm.value_or(plot.width_mm);
  plot.height_mm = arguments.height_mm;
  for (const auto& file : {arguments.svg, arguments.pdf, arguments.png})
    if (file) draw(plot, *file);
}

}  // namespace

int timeline(const TimelineArguments& arguments) {
  check_figure(arguments);
  return with_readable(find_results(arguments.folder), [&](std::vector<StoredComparison> all) {
    if (wants_figure(arguments))
      draw_all(std::move(all), arguments);
    else
      print_all(std::move(all), arguments);
  });
}

}  // namespace relock
