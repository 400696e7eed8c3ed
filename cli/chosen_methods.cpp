#include "cli/chosen_methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {

std::vector<std::size_t> chosen_runs(const StoredComparison& comparison,
                                     const std::vector<std::string>& methods, Yardsticks yardsticks) {
  std::vector<std::size_t> chosen, all;
  for (const std::string& method : methods)
    for (std::size_t i = 0; i < comparison.runs.size(); ++i)
      if (comparison.runs[i].record.method == method) chosen.push_back(i);
  if (!methods.empty()) return chosen;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    all.push_back(i);
    if (!comparison.runs[i].record.yardstick) chosen.push_back(i);
  }
  return yardsticks == Yardsticks::too || chosen.empty() ? all : chosen;
}

void check_methods(const std::vector<StoredComparison>& all, const std::vector<std::string>& methods) {
  std::vector<std::string> names;
  for (const StoredComparison& comparison : all)
    for (const StoredRun& run : comparison.runs)
      if (std::find(names.begin(), names.end(), run.record.method) == names.end())
        names.push_back(run.record.method);
  for (const std::string& method : methods)
    if (std::find(names.begin(), names.end(), method) == names.end())
      throw Error(fmt::format("there is no run of {}{}; there are runs of {}", method,
                              did_you_mean(method, names), fmt::join(names, ", ")));
}

StoredComparison only_one(std::vector<StoredComparison> all, std::string_view what) {
  if (all.size() == 1) return std::move(all.front());
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> folders;
  for (const StoredComparison& comparison : all)
    if (folders.size() < kNamed) folders.push_back(comparison.folder.string());
  throw Error(fmt::format(
      "{} is of one recording with one gap pattern, seed and protocol, and there are {}: name one, "
      "as {}{}",
      what, all.size(), fmt::join(folders, ", "), all.size() > kNamed ? ", …" : ""));
}

}  // namespace relock
