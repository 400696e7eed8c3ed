#include "cli/runs/plan.h"

#include <fmt/format.h>

#include <sstream>
#include <type_traits>

#include "cli/files.h"
#include "core/error.h"
#include "core/toml_table.h"
#include "eval/replay/answers_csv.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKeys{"sequences", "sequence", "methods", "gaps",          "protocols",
                                     "seeds",     "gate",     "out",     "frame_limit_s", "memory_limit_mb",
                                     "real_time", "latency",  "paired"};
const std::vector<std::string> kSequenceKeys{"path", "labels", "rate_hz", "format", "topic"};
const std::vector<std::string> kMethodKeys{"name", "options"};

class PlanReader {
 public:
  PlanReader(const toml::table& table, const fs::path& file)
      : root_(table, file.string(), kKeys), folder_(file.parent_path()) {}

  Plan read() {
    Plan plan;
    read_sequences(plan);
    for (const toml::node* node : root_.list("methods")) plan.methods.push_back(method(*node));
    if (plan.methods.empty()) missing("methods");
    if (root_.node("gaps")) plan.gaps.clear();
    for (const toml::node* node : root_.list("gaps")) plan.gaps.push_back(gaps(*node));
    if (root_.node("protocols")) plan.protocols.clear();
    for (const toml::node* node : root_.list("protocols"))
      plan.protocols.push_back(told_here(*node, [&] { return parse_protocol(text(*node)); }));
    if (root_.node("seeds")) plan.seeds.clear();
    for (const toml::node* node : root_.list("seeds")) plan.seeds.push_back(seed(*node));
    if (const auto gate = root_.word("gate"))
      plan.gate = told_here(*root_.node("gate"), [&] { return parse_gate(*gate); });
    read_real_time(plan);
    plan.out = beside(root_.word("out").value_or(plan.out.string()));
    plan.limits.frame_s = root_.positive("frame_limit_s", 0.01, 1e6).value_or(plan.limits.frame_s);
    plan.limits.memory_mb = root_.positive("memory_limit_mb", 1, 1e9).value_or(plan.limits.memory_mb);
    if (root_.value<bool>("paired", "true or false").value_or(false))
      told_here(*root_.node("paired"), [&] { pair_up(plan); });
    return plan;
  }

 private:
  void read_sequences(Plan& plan) {
    for (const toml::node* node : root_.list("sequences"))
      plan.sequences.push_back({sequence_path(text(*node)), {}});
    for (const toml::node* node : root_.list("sequence")) {
      const toml::table* table = node->as_table();
      if (!table) root_.fail(*node, "sequences with more than a path are written [[sequence]]");
      plan.sequences.push_back(sequence(TomlTable(*table, root_.file(), kSequenceKeys), *table));
    }
    if (plan.sequences.empty()) missing("sequences");
  }

  PlannedSequence sequence(const TomlTable& table, const toml::table& node) {
    const auto path = table.word("path");
    if (!path) table.fail(node, "this sequence has no path");
    PlannedSequence planned{sequence_path(*path), {}};
    if (const auto labels = table.word("labels")) planned.open.labels = beside(*labels);
    planned.open.rate_hz = table.positive("rate_hz");
    planned.open.format = table.word("format");
    planned.open.topic = table.word("topic");
    return planned;
  }

  /// "kcf(resize=false)", or {name = "kcf", options = {resize = false}}.
  MethodSpec method(const toml::node& node) {
    const toml::table* table = node.as_table();
    if (!table) {
      auto specs = told_here(node, [&] { return parse_methods(text(node)); });
      if (specs.size() != 1) root_.fail(node, "one method belongs here; a list has one text for each");
      return std::move(specs.front());
    }
    const TomlTable read(*table, root_.file(), kMethodKeys);
    const auto name = read.word("name");
    if (!name) read.fail(node, "this method has no name");
    MethodSpec spec{*name, {}};
    if (const toml::node* options = read.node("options")) {
      if (!options->as_table()) read.fail(*options, "options are written {name = value, ...}");
      for (const auto& [key, value] : *options->as_table())
        spec.options[std::string(key.str())] = option_value(value);
    }
    return spec;
  }

  std::string option_value(const toml::node& node) const {
    if (const auto word = node.value_exact<std::string>()) return *word;
    if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
    if (const auto whole = node.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
    if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
    root_.fail(node, "an option's value is a text, a number, true or false");
  }

  std::string gaps(const toml::node& node) const {
    const std::string pattern = text(node);
    constexpr std::string_view kTrace = "trace(";
    if (!pattern.starts_with(kTrace) || !pattern.ends_with(')')) return pattern;
    const auto file = pattern.substr(kTrace.size(), pattern.size() - kTrace.size() - 1);
    return fmt::format("{}{})", kTrace, beside(file).string());
  }

  void read_real_time(Plan& plan) {
    const auto waiting = root_.word("real_time"), latency = root_.word("latency");
    if (latency && !waiting)
      root_.fail(*root_.node("latency"), "a latency needs real_time beside it: latest or queue(n)");
    if (!waiting) return;
    const bool file = latency && fs::exists(beside(*latency));
    plan.real_time = told_here(*root_.node("real_time"), [&] {
      return parse_real_time(*waiting, file ? beside(*latency).string() : latency.value_or("measured"));
    });
  }

  std::uint64_t seed(const toml::node& node) const {
    const auto found = node.value_exact<std::int64_t>();
    if (!found || *found < 0) root_.fail(node, "a seed is a whole number from 0");
    return static_cast<std::uint64_t>(*found);
  }

  std::string text(const toml::node& node) const {
    if (const auto found = node.value_exact<std::string>()) return *found;
    root_.fail(node, "a text belongs here");
  }

  /// Runs `read`; what it refuses is told at the place of `node`.
  template <class Read>
  std::invoke_result_t<Read> told_here(const toml::node& node, const Read& read) const {
    try {
      return read();
    } catch (const Error& fault) {
      root_.fail(node, fault.what());
    }
  }

  [[noreturn]] void missing(std::string_view key) const {
    throw Error(fmt::format("{}: a plan needs {}", root_.file(), key));
  }

  fs::path beside(const fs::path& path) const { return path.is_absolute() ? path : folder_ / path; }
  /// A name that is not beside the plan may be one of relock's own recordings.
  fs::path sequence_path(const fs::path& path) const {
    return fs::exists(beside(path)) ? beside(path) : path;
  }

  TomlTable root_;
  fs::path folder_;
};

}  // namespace

void pair_up(Plan& plan) {
  std::erase(plan.gaps, "none");
  if (plan.gaps.empty())
    throw Error("a paired experiment compares a gap pattern with what was recorded; say which one (gaps)");
  plan.gaps.insert(plan.gaps.begin(), "none");
  plan.paired = true;
}

RealTime parse_real_time(const std::string& waiting, const std::string& latency) {
  RealTime real_time{parse_waiting(waiting), {}};
  if (!fs::is_regular_file(latency)) {
    real_time.latency = parse_latency(latency);
    return real_time;
  }
  std::istringstream text(read_file(latency));
  real_time.latency = read_latencies(text, latency);
  // Its place may change, its content may not.
  real_time.latency.text =
      fmt::format("{} {}", fs::path(latency).filename().string(), file_fingerprint(latency).substr(0, 12));
  return real_time;
}

Plan read_plan(const fs::path& file) {
  const toml::table table = parse_toml(file);
  return PlanReader(table, file).read();
}

}  // namespace relock
