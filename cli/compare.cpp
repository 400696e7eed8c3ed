// `relock compare A B`: what changed between two result folders, and whether that may be.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/compare/fail_if.h"
#include "cli/readable.h"
#include "cli/verbs.h"

namespace relock {
namespace {

constexpr int kFails = 1, kUntold = 2;

/// A condition that cannot be told must not pass for one that does not hold.
int status_of(const std::vector<Finding>& findings) {
  int status = 0;
  for (const Finding& finding : findings) {
    if (!finding.unknown.empty()) status = kUntold;
    if (!finding.because.empty()) status = std::max(status, kFails);
  }
  return status;
}

std::string text_of(const Finding& finding) {
  std::string text;
  const auto say = [&](std::string_view what, const std::string& why) {
    text += fmt::format("  {} '{}'{}\n", what, finding.condition.text, why.empty() ? "" : ": " + why);
  };
  for (const std::string& why : finding.because) say("fails", why);
  for (const std::string& why : finding.unknown) say("cannot tell", why);
  if (text.empty())
    say("passes", finding.unsure.empty() ? ""
                                         : fmt::format("too few data to be sure of anything of {}",
                                                       fmt::join(finding.unsure, "; ")));
  return text;
}

Json json_of(const std::vector<Finding>& findings) {
  Json all = Json::array();
  for (const Finding& finding : findings)
    all.push_back({{"condition", finding.condition.text},
                   {"holds", !finding.because.empty()},
                   {"because", finding.because},
                   {"too_few_data", finding.unsure},
                   {"cannot_tell", finding.unknown}});
  return all;
}

/// "results-old (relock 0.1.0)"
std::string name_of(const std::filesystem::path& folder, const std::vector<StoredComparison>& results) {
  std::vector<std::string> versions;
  for (const StoredComparison& comparison : results)
    for (const StoredRun& run : comparison.runs)
      if (std::find(versions.begin(), versions.end(), run.record.relock_version) == versions.end())
        versions.push_back(run.record.relock_version);
  std::sort(versions.begin(), versions.end());
  return fmt::format("{} (relock {})", folder.string(), fmt::join(versions, ", "));
}

int tell(const CompareArguments& arguments, const std::vector<MethodPair>& methods,
         const std::vector<FailCondition>& conditions, const std::vector<StoredComparison>& a,
         const std::vector<StoredComparison>& b) {
  const FolderChange change = changes(a, b, arguments.gate, methods);
  std::vector<Finding> findings;
  for (const FailCondition& condition : conditions) findings.push_back(check(condition, change));
  const FolderNames names{name_of(arguments.a, a), name_of(arguments.b, b)};
  if (arguments.json) {
    Json json = changes_json(change, names);
    json["fail_if"] = json_of(findings);
    fmt::print("{}", json_text(json));
  } else {
    fmt::print("{}{}", changes_text(change, names), findings.empty() ? "" : "\n");
    for (const Finding& finding : findings) fmt::print("{}", text_of(finding));
  }
  return status_of(findings);
}

}  // namespace

int compare(const CompareArguments& arguments) {
  if (arguments.gate) parse_gate(*arguments.gate);
  std::vector<MethodPair> methods;
  for (const std::string& text : arguments.pairs) methods.push_back(parse_method_pair(text));
  std::vector<FailCondition> conditions;
  for (const std::string& text : arguments.fail_if) conditions.push_back(parse_fail_if(text));
  const auto found_a = find_results(arguments.a), found_b = find_results(arguments.b);
  int told = 0, unreadable_in_b = 0;
  const int unreadable_in_a = with_readable(found_a, [&](const std::vector<StoredComparison>& a) {
    unreadable_in_b = with_readable(found_b, [&](const std::vector<StoredComparison>& b) {
      told = tell(arguments, methods, conditions, a, b);
    });
  });
  return std::max({told, unreadable_in_a, unreadable_in_b});
}

}  // namespace relock
