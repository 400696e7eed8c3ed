#include "cli/scores/tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace relock {
namespace {

/// ".07", "1.0", "12": two digits that matter, as narrow as they can be.
std::string bound(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (std::abs(value) >= 9.95) return fmt::format("{:.0f}", value);
  if (std::abs(value) >= 0.995) return fmt::format("{:.1f}", value);
  std::string text = fmt::format("{:.2f}", value);
  if (text == "0.00" || text == "-0.00") return "0";
  return text.erase(text.find('0'), 1);
}

std::string with_interval(const std::string& value, const std::optional<Interval>& interval) {
  return interval ? fmt::format("{} [{},{}]", value, bound(interval->low), bound(interval->high)) : value;
}

/// "0.912 [.85,.95]*": starred are the best and what ties with it; "?" where the data cannot tell.
std::string share_cell(const JudgedMethod& method, std::size_t which) {
  const auto& value = method.scores.*share_scores()[which].value;
  if (!value) return "n/a";
  const Standing standing = method.standings[which];
  return with_interval(cell(value, 3), method.shares[which]) +
         (standing == Standing::best || standing == Standing::tied ? "*"
          : standing == Standing::untold                           ? "?"
                                                                   : " ");
}

/// Localization finer than two standard deviations of the labels says nothing of the method.
std::string fix_cell(const Localization& l, const std::optional<double>& px) {
  if (px && l.label_sigma_px && *px < 2 * *l.label_sigma_px)
    return fmt::format("<{:.2f}", 2 * *l.label_sigma_px);
  return cell(px, 2);
}

std::string recovery_cell(const JudgedMethod& method) {
  const Recovery& r = method.scores.recovery;
  if (r.losses == 0) return "-";
  const std::string value =
      r.median_s ? fmt::format("{:.2f}", *r.median_s) : fmt::format(">{:.2f}", r.follow_up_s);
  return with_interval(value, method.scores.recovery.median_s_interval);
}

std::string age_cell(const std::optional<double>& age) {
  return age && std::isinf(*age) ? "never" : cell(age, 2);
}

std::string median_cell(const JudgedMethod& method) {
  const Localization& l = method.scores.localization;
  const std::string value = fix_cell(l, l.median_px);
  return value.starts_with("<") ? value : with_interval(value, method.median_px);
}

enum : std::size_t {
  kRecognition,
  kPrecision,
  kAvailability,
  kAvailabilityOfCeiling,
  kLocked,
  kLockedOfCeiling
};

std::string part_cell(std::size_t part, std::size_t whole) {
  if (whole == 0) return "n/a";
  return fmt::format("{:.3f}", static_cast<double>(part) / static_cast<double>(whole));
}

std::string seeds_text(const std::set<std::uint64_t>& seeds) {
  return fmt::format("{} {}", seeds.size() == 1 ? "seed" : "seeds", fmt::join(seeds, ", "));
}

}  // namespace

std::vector<JudgedTable> judged_tables(std::vector<ScorePool> pools) {
  std::vector<JudgedTable> all;
  for (ScorePool& pool : pools)
    for (ScoreTable& table : std::move(pool).tables()) {
      auto methods = judged(table);
      all.push_back({std::move(table), std::move(methods)});
    }
  std::stable_sort(all.begin(), all.end(), [](const JudgedTable& a, const JudgedTable& b) {
    return a.table.conditions < b.table.conditions;
  });
  return all;
}

void keep_targets_of_single_recordings(std::vector<JudgedTable>& tables) {
  std::set<TableConditions> several;
  for (const JudgedTable& judged : tables)
    if (judged.table.grouping == Grouping::none && judged.table.recordings.size() > 1)
      several.insert(judged.table.conditions);
  std::erase_if(tables, [&](const JudgedTable& judged) {
    return judged.table.grouping == Grouping::target && several.contains(judged.table.conditions);
  });
}

std::string heading(const ScoreTable& table) {
  const std::string what = table.recordings.size() == 1
                               ? *table.recordings.begin()
                               : fmt::format("{} recordings", table.recordings.size());
  const TableConditions& c = table.conditions;
  const std::string gaps =
      c.gaps == "none" ? "as recorded" : fmt::format("gaps {} ({})", c.gaps, seeds_text(table.seeds));
  const std::string starts = table.starts.empty() ? "" : fmt::format(" ({} starts)", table.starts.size());
  const std::string real_time =
      c.real_time.empty() ? "" : fmt::format(", real time ({}, latency {})", c.real_time, c.latency);
  return fmt::format("{}, {}, protocol {}{}, gate {}{}", what, gaps, c.protocol, starts, c.gate, real_time);
}

Table keeping_table(const JudgedTable& judged) {
  Table table({"method", "recognition ", "available ", "/ceiling", "locked ", "/ceiling", "losses", "/min",
               "recover s"});
  for (std::size_t i = 0; i < judged.methods.size(); ++i) {
    const JudgedMethod& m = judged.methods[i];
    const Scores& s = m.scores;
    table.add({judged.table.methods[i].method, share_cell(m, kRecognition), share_cell(m, kAvailability),
               cell(s.availability_of_ceiling, 3), share_cell(m, kLocked), cell(s.locked_share_of_ceiling, 3),
               std::to_string(s.losses), with_interval(cell(s.losses_per_minute, 1), m.losses_per_minute),
               recovery_cell(m)});
  }
  return table;
}

Table exactness_table(const JudgedTable& judged) {
  Table table({"method", "precision", "silent", "age s", "p95", "e px", "p95", "% D", "common e"});
  for (std::size_t i = 0; i < judged.methods.size(); ++i) {
    const JudgedMethod& m = judged.methods[i];
    const Scores& s = m.scores;
    const Localization& l = s.localization;
    table.add({judged.table.methods[i].method, cell(s.precision, 3), cell(s.silent_share, 2),
               age_cell(s.fix_age.median_s), age_cell(s.fix_age.p95_s), median_cell(m), fix_cell(l, l.p95_px),
               cell(l.median_percent, 1), fix_cell(m.common, m.common.median_px)});
  }
  return table;
}

Table blur_table(const JudgedTable& judged) {
  Table table(
      {"method", "blurred", "told", "direction deg", "p95", "length %", "p95", "sharp", "said blurred"});
  for (std::size_t i = 0; i < judged.methods.size(); ++i) {
    const BlurAccuracy& b = judged.methods[i].scores.blur;
    if (!b.any()) continue;
    table.add({judged.table.methods[i].method, fmt::format("{}", b.blurred), part_cell(b.told, b.blurred),
               cell(b.direction_median_deg, 1), cell(b.direction_p95_deg, 1),
               cell(b.length_median_percent, 1), cell(b.length_p95_percent, 1), fmt::format("{}", b.sharp),
               part_cell(b.sharp_blurred, b.sharp)});
  }
  return table;
}

Table real_time_table(const ScoreTable& table) {
  Table lines({"method", "own frames", "skipped", "in force", "slowness", "gaps", "failure", "age s", "p95"});
  for (const MethodPool& method : table.methods) {
    const RealTimeScores& s = method.real_time;
    const auto lost = [&](LostTo cause) {
      return part_cell(s.lost[static_cast<std::size_t>(cause)], s.in_force);
    };
    const auto age = [&](double at) {
      return s.answer_age_s.empty() ? "n/a" : age_cell(percentile(s.answer_age_s, at));
    };
    lines.add({method.method, part_cell(s.own_hits, s.own), part_cell(s.skipped, s.delivered),
               part_cell(s.hits, s.in_force), lost(LostTo::slowness), lost(LostTo::gaps),
               lost(LostTo::failure), age(0.5), age(0.95)});
  }
  return lines;
}

Table cost_table(const JudgedTable& judged) {
  Table lines({"method", "wall ms", "p95", "max", "CPU ms", "p95", "max", "skipped", "peak MB"});
  for (std::size_t i = 0; i < judged.methods.size(); ++i) {
    const MethodPool& method = judged.table.methods[i];
    const std::optional<Cost>& cost = judged.methods[i].cost;
    std::vector<std::string> row{method.method};
    for (const Spread Cost::*time : {&Cost::wall, &Cost::cpu})
      for (const double Spread::*ms : {&Spread::median_ms, &Spread::p95_ms, &Spread::max_ms})
        row.push_back(cost ? cell((*cost).*time.*ms, 2) : "n/a");
    const std::size_t skipped = method.tally.verdicts[static_cast<std::size_t>(Verdict::Skipped)];
    row.push_back(part_cell(skipped, method.tally.frames));
    row.push_back(cost ? cell(1e-6 * static_cast<double>(cost->peak_bytes), 0) : "n/a");
    lines.add(row);
  }
  return lines;
}

Table bins_table(const std::vector<const JudgedTable*>& bins) {
  std::vector<std::string> header{"method"}, methods;
  for (const JudgedTable* bin : bins) {
    header.push_back(bin->table.group);
    for (const MethodPool& method : bin->table.methods)
      if (std::find(methods.begin(), methods.end(), method.method) == methods.end())
        methods.push_back(method.method);
  }
  Table table(header);
  for (const std::string& method : methods) {
    std::vector<std::string> row{method};
    for (const JudgedTable* bin : bins) {
      const auto at = std::find_if(bin->table.methods.begin(), bin->table.methods.end(),
                                   [&](const MethodPool& m) { return m.method == method; });
      const auto i = static_cast<std::size_t>(at - bin->table.methods.begin());
      row.push_back(at == bin->table.methods.end() ? "n/a" : share_cell(bin->methods[i], kRecognition));
    }
    table.add(row);
  }
  return table;
}

std::string_view table_footnote() {
  return R"(
  [low,high] 95 % intervals, where the data tell. * the best, or tied with it by the paired difference; ? too few data to
  tell it from the best; yardsticks apart. recover s: Kaplan-Meier median, > where no more than half recovered while watched.
  silent: share of lost time with a wrong answer. age s: of the newest Hit, median and p95. e px, p95, % D: position error
  over Hits, < where it is below the accuracy of the labels (two standard deviations). common e: over Hits common to all.
)";
}

std::string_view blur_footnote() {
  return R"(
  blurred, sharp: Hits where the true blur is at least .1 D, at most .05 D. told: share of blurred with an estimate, and
  how far that is off the true direction and length, median and p95. said blurred: share of sharp with one over .1 D.
)";
}

std::string_view real_time_footnote() {
  return R"(
  own frames: recognition on the frames that the method came to, skipped ones being no Hits. in force, and lost to
  slowness, gaps and failure: of the visible frames, by the answer that was there; they add up to 1. age s: of that answer.
)";
}

}  // namespace relock
