#include "cli/real_time.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/table.h"
#include "eval/in_force.h"
#include "eval/localization.h"

namespace relock {
namespace {

std::string share(std::size_t part, std::size_t whole) {
  if (whole == 0) return "n/a";
  return fmt::format("{:.3f}", static_cast<double>(part) / static_cast<double>(whole));
}

/// Of ages, some of which may be infinite: between two of which one is, it is infinite.
std::string age(const std::vector<double>& ages, double at) {
  if (ages.empty()) return "n/a";
  const double s = percentile(ages, at);
  return std::isfinite(s) ? fmt::format("{:.3f}", s) : "never";
}

std::vector<std::string> row(const std::string& method, const RealTimeScores& s) {
  const auto lost = [&](LostTo cause) { return share(s.lost[static_cast<std::size_t>(cause)], s.in_force); };
  return {method,
          share(s.own_hits, s.own),
          share(s.skipped, s.delivered),
          share(s.hits, s.in_force),
          lost(LostTo::slowness),
          lost(LostTo::gaps),
          lost(LostTo::failure),
          age(s.answer_age_s, 0.5),
          age(s.answer_age_s, 0.95)};
}

}  // namespace

void print_real_time(const ScoredComparison& compared) {
  const StoredComparison& stored = compared.stored;
  const RunRecord& record = stored.runs.front().record;
  if (record.real_time.empty()) return;
  std::vector<std::vector<RealTimeScores>> scores;
  for (const StoredRun& run : stored.runs)
    scores.push_back(score_real_time(stored.recording, run.trajectory, run.answers, compared.gate));
  for (std::size_t t = 0; t < stored.recording.targets.size(); ++t) {
    Table table(
        {"method", "own frames", "skipped", "in force", "slowness", "gaps", "failure", "age s", "p95"});
    std::size_t rows = 0;
    for (std::size_t i = 0; i < stored.runs.size(); ++i) {
      if (!stored.runs[i].trajectory.judged_from[t]) continue;
      table.add(row(stored.runs[i].record.method, scores[i][t]));
      ++rows;
    }
    if (rows == 0) continue;
    fmt::print("\n  target {}, real time ({}, latency {})\n{}", stored.recording.targets[t].id,
               record.real_time, record.latency, table.text(2));
  }
  fmt::print(
      "  own frames: recognition on the frames that the method came to, skipped ones being no Hits. in "
      "force, and lost "
      "to\n  slowness, gaps and failure: of the visible frames, by the answer that was there; they add up to "
      "1.\n");
}

}  // namespace relock
