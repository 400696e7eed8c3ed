// `relock report`: one page of everything that results tell, to be sent to somebody who was not there.

#include "cli/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "cli/comparison.h"
#include "cli/files.h"
#include "cli/readable.h"
#include "cli/report/answers.h"
#include "cli/report/encoded.h"
#include "cli/report/pictures.h"
#include "cli/report/provenance.h"
#include "cli/report/timelines.h"
#include "cli/report/why.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

using namespace reports;

std::string command_of(const ReportArguments& a) {
  std::string text = "relock report results";
  if (a.gate) text += " --gate " + shell_word(*a.gate);
  return text + " -o " + shell_word(a.out.filename().string());
}

std::vector<JudgedTable> tables_of(const std::vector<ScoredComparison>& all, std::size_t recordings) {
  std::vector<ScorePool> pools;
  if (recordings < kRecordingsToResample) pools.emplace_back(Grouping::target, recordings);
  pools.emplace_back(Grouping::none, recordings);
  for (const ScoredComparison& compared : all) {
    for (ScorePool& pool : pools) pool.add(compared);
    pools.back().add_costs(compared, read_costs(compared.stored));
  }
  auto tables = judged_tables(std::move(pools));
  keep_targets_of_single_recordings(tables);
  return tables;
}

std::string title_of(const std::vector<ScoredComparison>& all) {
  std::vector<std::string> names;
  for (const ScoredComparison& compared : all)
    if (std::find(names.begin(), names.end(), compared.stored.recording.name) == names.end())
      names.push_back(compared.stored.recording.name);
  return names.size() == 1 ? names.front() : fmt::format("{} recordings", names.size());
}

int jobs_here() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

Json data_of(std::vector<StoredComparison> stored, const ReportArguments& a, std::size_t recordings) {
  const Json why = why_json(pooled(stored, a.gate), jobs_here());
  const Json provenance = provenance_json(stored, command_of(a));
  std::vector<ScoredComparison> all;
  for (StoredComparison& comparison : stored) {
    const Gate gate = gate_of(comparison, a.gate);
    all.push_back(scored(std::move(comparison), gate));
  }
  Json comparisons = Json::array();
  for (const ScoredComparison& compared : all) comparisons.push_back(timelines_json(compared));
  const auto budget = static_cast<std::size_t>(a.pictures_mb * 1e6);
  const Pictures pictures = pictures_of(all, {budget, a.sequences});
  for (std::size_t i = 0; i < all.size(); ++i) comparisons[i].update(pictures.of_comparisons[i]);
  const auto map = map_picture(a.folder);
  return {{"title", title_of(all)},
          {"tables", answers_json(tables_of(all, recordings))},
          {"comparisons", comparisons},
          {"recordings", pictures.recordings},
          {"pictures",
           {{"wanted", pictures.wanted},
            {"kept", pictures.kept},
            {"budget_mb", a.pictures_mb},
            {"missing", pictures.missing}}},
          {"why", why},
          {"map", map ? Json(*map) : Json()},
          {"packed_step", kPackedStep},
          {"provenance", provenance}};
}

}  // namespace

int report(const ReportArguments& arguments) {
  if (arguments.gate) parse_gate(*arguments.gate);
  const auto found = find_results(arguments.folder);
  return with_readable(found, [&](std::vector<StoredComparison> all) {
    const Json data = data_of(std::move(all), arguments, recordings_in(found));
    const std::string text = page(data);
    write_file(arguments.out, text);
    fmt::print("{} ({:.1f} MB, {} pictures): open it in any browser, or send it\n", arguments.out.string(),
               1e-6 * static_cast<double>(text.size()), data["pictures"]["kept"].get<std::size_t>());
    for (const Json& why : data["pictures"]["missing"])
      fmt::print("without pictures: {}\n", why.get<std::string>());
  });
}

}  // namespace relock
