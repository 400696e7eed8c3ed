#include "cli/report/provenance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/version.h"

namespace relock::reports {
namespace {

/// Methods that were asked for: yardsticks come by themselves.
std::vector<std::string> methods_of(const StoredComparison& comparison) {
  std::vector<std::string> methods, yardsticks;
  for (const StoredRun& run : comparison.runs)
    if (!run.record.imported())
      (run.record.yardstick ? yardsticks : methods).push_back(shell_word(run.record.method));
  return methods.empty() ? yardsticks : methods;
}

std::string command_of(const StoredComparison& comparison) {
  const RunRecord& record = comparison.runs.front().record;
  std::string text =
      fmt::format("relock run --sequence {} --methods {} --protocol {}", shell_word(record.recording),
                  fmt::join(methods_of(comparison), ","), to_string(record.protocol));
  if (record.gaps != "none") text += fmt::format(" --gaps {}", shell_word(record.gaps));
  text += fmt::format(" --seed {}", record.seed);
  if (record.gate == to_string(Gate::iou())) text += " --gate iou";
  if (!record.real_time.empty())
    text +=
        fmt::format(" --real-time {} --latency {}", shell_word(record.real_time), shell_word(record.latency));
  return text + " --out results";
}

Json options_json(const RunRecord& record) {
  std::string text;
  for (const auto& [name, value] : record.options)
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", name, value);
  return text;
}

Json run_json(const StoredRun& run) {
  const RunRecord& r = run.record;
  Json failures = Json::array();
  for (const Failure& failure : r.failures)
    failures.push_back(fmt::format("frame {}: {}", failure.frame, failure.what));
  return {{"recording", r.recording},
          {"method", r.method},
          {"options", options_json(r)},
          {"protocol", spoken(r.showing())},
          {"gaps", r.gaps},
          {"seed", r.seed},
          {"relock", r.relock_version},
          {"program", r.program},
          {"opencv", r.opencv_version},
          {"fingerprint", r.fingerprint},
          {"deterministic", r.deterministic},
          {"failures", failures}};
}

}  // namespace

std::string shell_word(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./:,=+%@").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

Json provenance_json(const std::vector<StoredComparison>& all, const std::string& report_command) {
  std::vector<std::string> commands;
  Json runs = Json::array();
  for (const StoredComparison& comparison : all) {
    for (const StoredRun& run : comparison.runs) runs.push_back(run_json(run));
    if (methods_of(comparison).empty()) continue;  // all of them were imported
    const std::string command = command_of(comparison);
    if (std::find(commands.begin(), commands.end(), command) == commands.end()) commands.push_back(command);
  }
  commands.push_back(report_command);
  return {{"relock", kVersion}, {"commands", commands}, {"runs", runs}};
}

}  // namespace relock::reports
