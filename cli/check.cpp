// `relock check`: whether methods keep what trackers and detectors promise.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>

#include "cli/catalogue.h"
#include "cli/conformance/conformance.h"
#include "cli/json_text.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

using Kind = CheckResult::Kind;

std::vector<MethodSpec> wanted(const CheckArguments& arguments, const Methods& methods) {
  if (!arguments.all && arguments.methods.empty())
    throw Error("name the methods to check, or give --all; `relock list` shows them");
  if (!arguments.all) return parse_methods(arguments.methods);
  if (!arguments.methods.empty()) throw Error("give either methods or --all, not both");
  std::vector<MethodSpec> all;
  for (const std::string& name : methods.trackers.names()) all.push_back({name, {}});
  for (const std::string& name : methods.detectors.names()) all.push_back({name, {}});
  return all;
}

ConformanceOptions options_of(const CheckArguments& arguments) {
  if (arguments.frames < 20) throw Error("--frames must be at least 20: fewer do not show what grows");
  if (!(arguments.budget_s > 0) || !(arguments.silence_s > 0) || arguments.budget_s > 1e6 ||
      arguments.silence_s > 1e6)
    throw Error("--budget and --silence must be seconds above 0, at most 1000000");
  ConformanceOptions options;
  options.only = arguments.only;
  options.frames = arguments.frames;
  options.budget = from_seconds(arguments.budget_s);
  options.silence = from_seconds(arguments.silence_s);
  return options;
}

void print_last(const Conformance& so_far) {
  const CheckResult& check = so_far.checks.back();
  if (so_far.checks.size() == 1) fmt::print("{} ({})\n", so_far.method, so_far.kind);
  const std::string line = fmt::format("  {:<9} {:<9}  {}", check.check, to_string(check.kind), check.reason);
  fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  std::fflush(stdout);  // the next one may take a minute
}

void print_counts(const Conformance& all) {
  const std::size_t known = all.count(Kind::known);
  fmt::print("  {} passed, {} failed, {} not asked{}\n", all.count(Kind::passed), all.count(Kind::failed),
             all.count(Kind::not_asked), known == 0 ? "" : fmt::format(", {} known to fail", known));
}

void print_json(const std::vector<Conformance>& all) {
  Json json = Json::array();
  for (const Conformance& one : all) {
    Json checks = Json::array();
    for (const CheckResult& check : one.checks)
      checks.push_back({{"check", check.check}, {"result", to_string(check.kind)}, {"reason", check.reason}});
    json.push_back({{"method", one.method}, {"kind", one.kind}, {"checks", checks}});
  }
  fmt::print("{}", json_text(json));
}

}  // namespace

int check(const CheckArguments& arguments, const Methods& methods) {
  const ConformanceOptions options = options_of(arguments);
  cv::setNumThreads(1);  // as a run does
  std::vector<Conformance> all;
  for (const MethodSpec& spec : wanted(arguments, methods)) {
    try {
      all.push_back(check_method(methods, spec, options, [&](const Conformance& so_far) {
        if (!arguments.json) print_last(so_far);
      }));
    } catch (const Error& fault) {
      if (!arguments.all) throw;
      fmt::print(stderr, "not checked: {}\n", fault.what());  // one that needs an option, a network say
      continue;
    }
    if (!arguments.json) print_counts(all.back());
  }
  if (arguments.json) print_json(all);
  return std::any_of(all.begin(), all.end(), [](const Conformance& c) { return c.count(Kind::failed) > 0; });
}

}  // namespace relock
