// `relock compatibility`: the scores that the toolkits of VOT, OTB, GOT-10k and evo would give to runs.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "cli/benchmark_files.h"
#include "cli/json_text.h"
#include "cli/readable.h"
#include "cli/runs/folder.h"
#include "cli/table.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "eval/compatibility/ape.h"
#include "eval/compatibility/got10k.h"
#include "eval/compatibility/otb.h"
#include "eval/compatibility/vot.h"
#include "eval/compatibility/vot_multistart.h"

namespace relock {
namespace {

/// A method's answers on all recordings, under one condition.
struct Answers {
  std::string method;
  std::vector<AnsweredSequence> sequences;
};

/// Runs that were made with the same gaps, seed and protocol, over all recordings.
struct Group {
  std::string condition;  ///< "recorded-once"
  Protocol protocol = Protocol::once;
  std::vector<Answers> methods;  ///< in the order of the results

  Answers& of(const std::string& method) {
    for (Answers& answers : methods)
      if (answers.method == method) return answers;
    return methods.emplace_back(Answers{method, {}});
  }
};

struct ToolkitOptions {
  VotOptions vot;
  VotMultistartOptions multistart;
  Alignment alignment = Alignment::none;
  std::string alignment_name;
};

/// "recorded-once"; all anchors of protocol multistart are one condition.
std::string condition_of(const StoredComparison& comparison) {
  std::string name = comparison.folder.filename().string();
  const auto& anchor = comparison.runs.front().record.anchor;
  if (!anchor) return name;
  const std::string text = fmt::format("-{:04}-{}", anchor->frame, to_string(anchor->direction));
  if (const auto at = name.rfind(text); at != std::string::npos) name.erase(at, text.size());
  return name;
}

std::vector<Group> grouped(const std::vector<StoredComparison>& all) {
  std::map<std::string, Group> groups;
  for (const StoredComparison& comparison : all) {
    const std::string condition = condition_of(comparison);
    Group& group = groups[condition];
    group.condition = condition;
    group.protocol = comparison.runs.front().record.protocol;
    for (const StoredRun& run : comparison.runs) {
      Answers& answers = group.of(run.record.method);
      for (std::size_t t = 0; t < comparison.recording.targets.size(); ++t)
        if (auto sequence = answers_for(comparison.recording, run.trajectory, t))
          answers.sequences.push_back(std::move(*sequence));
    }
  }
  std::vector<Group> sorted;
  for (auto& [condition, group] : groups) sorted.push_back(std::move(group));
  return sorted;
}

std::string count(std::size_t n) { return fmt::format("{}", n); }

void print_otb(const Group& group) {
  Table table({"method", "sequences", "AUC", "success 0.5", "precision 20 px"});
  for (const Answers& a : group.methods) {
    const OtbScores s = otb_scores(a.sequences);
    table.add(
        {a.method, count(s.sequences), cell(s.auc, 4), cell(s.success_rate, 4), cell(s.precision_20, 4)});
  }
  fmt::print("\n  OTB (tracker_benchmark 1.0, one pass)\n{}", table.text(2));
}

void print_got10k(const Group& group) {
  Table table({"method", "frames", "AO", "SR 0.50", "SR 0.75"});
  for (const Answers& a : group.methods) {
    const Got10kScores s = got10k_scores(a.sequences);
    table.add({a.method, count(s.frames), cell(s.ao, 4), cell(s.sr50, 4), cell(s.sr75, 4)});
  }
  fmt::print("\n  GOT-10k (toolkit 0.1.3)\n{}", table.text(2));
}

void print_vot(const Group& group, const VotOptions& options) {
  Table table({"method", "frames", "accuracy", "failures", "robustness", "EAO"});
  for (const Answers& a : group.methods) {
    const VotScores s = vot_scores(a.sequences, options);
    table.add({a.method, count(s.frames), cell(s.accuracy, 4), count(s.failures), cell(s.robustness, 4),
               cell(s.eao, 4)});
  }
  fmt::print("\n  VOT (toolkit 0.8.0, supervised; burn-in {}, S = {}, EAO from {} to {} frames)\n{}",
             options.burn_in, options.sensitivity, options.eao_low, options.eao_high, table.text(2));
}

void print_multistart(const Group& group, const VotMultistartOptions& options) {
  Table table({"method", "runs", "accuracy", "failures", "robustness", "EAO"});
  for (const Answers& a : group.methods) {
    const VotMultistartScores s = vot_multistart_scores(a.sequences, options);
    table.add({a.method, count(s.runs), cell(s.accuracy, 4), count(s.failures), cell(s.robustness, 4),
               cell(s.eao, 4)});
  }
  fmt::print("\n  VOT (toolkit 0.8.0, multi-start; threshold {}, grace {}, EAO from {} to {} frames)\n{}",
             options.threshold, options.grace, options.eao_low, options.eao_high, table.text(2));
}

void print_ape(const Group& group, const ToolkitOptions& options) {
  Table table({"method", "frames", "rmse", "mean", "median", "std", "max"});
  for (const Answers& a : group.methods) {
    const ApeScores s = ape_scores(a.sequences, options.alignment);
    table.add({a.method, count(s.frames), cell(s.rmse_px, 3), cell(s.mean_px, 3), cell(s.median_px, 3),
               cell(s.std_px, 3), cell(s.max_px, 3)});
  }
  fmt::print("\n  evo (v1.36.5, APE of centres, px; alignment {})\n{}", options.alignment_name,
             table.text(2));
}

std::vector<std::string> names_of(const std::vector<AnsweredSequence>& sequences) {
  std::vector<std::string> names;
  for (const AnsweredSequence& sequence : sequences)  // protocol multistart: many of one name
    if (std::find(names.begin(), names.end(), sequence.name) == names.end()) names.push_back(sequence.name);
  return names;
}

void print(const Group& group, const ToolkitOptions& options) {
  std::vector<std::string> names;
  for (const Answers& a : group.methods)
    if (const auto all = names_of(a.sequences); all.size() > names.size()) names = all;
  fmt::print("{}: {}\n", group.condition, fmt::join(names, ", "));
  if (fits(ResultFormat::otb, group.protocol)) {
    print_otb(group);
    print_got10k(group);
  }
  if (fits(ResultFormat::vot, group.protocol)) print_vot(group, options.vot);
  if (group.protocol == Protocol::multistart) print_multistart(group, options.multistart);
  if (fits(ResultFormat::tum, group.protocol)) print_ape(group, options);
}

Json scores_of(const Group& group, const std::string& method, std::span<const AnsweredSequence> sequences,
               const ToolkitOptions& options) {
  Json json{{"condition", group.condition},
            {"protocol", to_string(group.protocol)},
            {"method", method},
            {"sequences", names_of({sequences.begin(), sequences.end()})}};
  if (fits(ResultFormat::otb, group.protocol)) {
    const OtbScores o = otb_scores(sequences);
    json["otb"] = {{"auc", number(o.auc)},
                   {"success_rate", number(o.success_rate)},
                   {"precision_20_px", number(o.precision_20)},
                   {"success", o.success},
                   {"precision", o.precision}};
    const Got10kScores g = got10k_scores(sequences);
    json["got10k"] = {{"frames", g.frames},
                      {"ao", number(g.ao)},
                      {"sr50", number(g.sr50)},
                      {"sr75", number(g.sr75)},
                      {"success", g.success}};
  }
  if (fits(ResultFormat::vot, group.protocol)) {
    const VotScores v = vot_scores(sequences, options.vot);
    json["vot"] = {{"frames", v.frames},
                   {"accuracy", number(v.accuracy)},
                   {"failures", v.failures},
                   {"failures_mean", number(v.failures_mean)},
                   {"robustness", number(v.robustness)},
                   {"eao", number(v.eao)},
                   {"eao_low", options.vot.eao_low},
                   {"eao_high", options.vot.eao_high},
                   {"expected_overlap", v.expected_overlap}};
  }
  if (group.protocol == Protocol::multistart) {
    const VotMultistartScores v = vot_multistart_scores(sequences, options.multistart);
    json["vot_multistart"] = {{"runs", v.runs},
                              {"accuracy", number(v.accuracy)},
                              {"failures", v.failures},
                              {"robustness", number(v.robustness)},
                              {"eao", number(v.eao)},
                              {"eao_low", options.multistart.eao_low},
                              {"eao_high", options.multistart.eao_high},
                              {"expected_overlap", v.expected_overlap}};
  }
  if (fits(ResultFormat::tum, group.protocol)) {
    const ApeScores e = ape_scores(sequences, options.alignment);
    json["evo"] = {{"alignment", options.alignment_name}, {"frames", e.frames},
                   {"rmse_px", number(e.rmse_px)},        {"mean_px", number(e.mean_px)},
                   {"median_px", number(e.median_px)},    {"std_px", number(e.std_px)},
                   {"max_px", number(e.max_px)}};
  }
  return json;
}

/// Every method on all sequences, and where there are several, on each.
Json json_of(const std::vector<Group>& groups, const ToolkitOptions& options) {
  Json all = Json::array();
  for (const Group& group : groups) {
    for (const Answers& a : group.methods) {
      all.push_back(scores_of(group, a.method, a.sequences, options));
      for (std::size_t i = 0; a.sequences.size() > 1 && i < a.sequences.size(); ++i)
        all.push_back(scores_of(group, a.method, std::span(a.sequences).subspan(i, 1), options));
    }
  }
  return all;
}

ToolkitOptions options_of(const CompatibilityArguments& arguments) {
  ToolkitOptions options;
  options.alignment = parse_alignment(arguments.align);
  options.alignment_name = arguments.align;
  if (arguments.eao_range.empty()) return options;
  options.vot.eao_low = arguments.eao_range.front();
  options.vot.eao_high = arguments.eao_range.back();
  options.multistart.eao_low = options.vot.eao_low;
  options.multistart.eao_high = options.vot.eao_high;
  if (options.vot.eao_low < 1 || options.vot.eao_low > options.vot.eao_high)
    throw Error(fmt::format("--eao {} {} is no range of lengths, such as 100 356", options.vot.eao_low,
                            options.vot.eao_high));
  return options;
}

}  // namespace

int compatibility(const CompatibilityArguments& arguments) {
  const ToolkitOptions options = options_of(arguments);
  return with_readable(find_results(arguments.folder), [&](const std::vector<StoredComparison>& results) {
    const std::vector<Group> groups = grouped(results);
    if (arguments.json) fmt::print("{}", json_text(json_of(groups, options)));
    for (std::size_t i = 0; !arguments.json && i < groups.size(); ++i) {
      fmt::print("{}", i > 0 ? "\n" : "");
      print(groups[i], options);
    }
  });
}

}  // namespace relock
