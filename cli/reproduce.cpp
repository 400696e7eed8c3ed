// `relock reproduce`: the paper's experiments, run again.

#include <fmt/format.h>

#include <opencv2/core/ocl.hpp>
#include <opencv2/core/utility.hpp>

#include "cli/files.h"
#include "cli/reproduce/experiment.h"
#include "cli/reproduce/folder.h"
#include "cli/reproduce/report.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

using reproduction::Experiment;
using reproduction::Finding;
using reproduction::Settings;

Settings settings_of(const ReproduceArguments& a) {
  return {.out = a.out.value_or(a.quick ? "reproduction-quick" : "reproduction"),
          .quick = a.quick,
          .jobs = a.jobs};
}

/// Those that were asked for, in the paper's order; all when none was.
std::vector<Experiment> chosen(const std::vector<std::string>& only) {
  const std::vector<Experiment>& all = reproduction::experiments();
  std::vector<std::string> names;
  for (const Experiment& experiment : all) names.push_back(experiment.name);
  for (const std::string& name : only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(fmt::format("--only {}: there is no such experiment{}; they are {}", name,
                              did_you_mean(name, names), fmt::join(names, ", ")));
  if (only.empty()) return all;
  std::vector<Experiment> some;
  for (const Experiment& experiment : all)
    if (std::find(only.begin(), only.end(), experiment.name) != only.end()) some.push_back(experiment);
  return some;
}

std::string closing(const Settings& settings) {
  std::string text;
  if (!can_plot())
    text += "\nThere is no gnuplot here, so that no plots were drawn; all their figures are there.\n";
  return text + fmt::format("\nAll of it is in {}: reproduction.txt, reproduction.json, plots and pictures\n",
                            settings.out.string());
}

}  // namespace

int reproduce(const ReproduceArguments& arguments, const Methods& methods) {
  cv::setNumThreads(1);  // the same bytes on any machine
  cv::ocl::setUseOpenCL(false);
  const Settings settings = settings_of(arguments);
  const std::vector<Experiment> experiments = chosen(arguments.only);
  const ResultsLock lock = reproduction::prepare_reproduction(settings);
  std::vector<Finding> findings;
  for (const Experiment& experiment : experiments)
    for (Finding& finding : experiment.run(settings, methods)) findings.push_back(std::move(finding));
  reproduction::mark_quick(findings, settings);
  const auto files = reproduction::write_plots(findings, settings);
  const std::string text = reproduction::text_of(findings);
  const std::string json = reproduction::json_of(findings, files, settings);
  write_file(settings.out / "reproduction.txt", text);
  write_file(settings.out / "reproduction.json", json);
  fmt::print("{}", arguments.json ? json : text + closing(settings));
  return 0;
}

}  // namespace relock
