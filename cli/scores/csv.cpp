#include <fmt/format.h>

#include <cmath>

#include "cli/scores/files.h"
#include "core/csv.h"

namespace relock {
namespace {

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; }

class Rows {
 public:
  void of(const JudgedTable& judged) {
    for (std::size_t i = 0; i < judged.methods.size(); ++i) {
      const TableConditions& c = judged.table.conditions;
      begin_ =
          fmt::format("{},{},{},{},{},{},{},{}", csv_cell(c.protocol), csv_cell(c.gaps), csv_cell(c.gate),
                      csv_cell(c.real_time), csv_cell(c.latency), to_string(judged.table.grouping),
                      csv_cell(judged.table.group), csv_cell(judged.table.methods[i].method));
      if (judged.table.grouping == Grouping::blur || judged.table.grouping == Grouping::gap)
        share(judged.methods[i], 0);
      else
        all_of(judged.methods[i]);
    }
  }
  std::string text() && { return std::move(text_); }

 private:
  void all_of(const JudgedMethod& method) {
    const Scores& s = method.scores;
    const Localization& l = s.localization;
    for (std::size_t i = 0; i < kShareScores; ++i) share(method, i);
    row("losses", static_cast<double>(s.losses));
    row("losses_per_minute", s.losses_per_minute, method.losses_per_minute);
    row("time_to_recover_median_s", s.recovery.median_s, method.scores.recovery.median_s_interval);
    row("silent_share", s.silent_share);
    row("f1", s.f1);
    row("wrong_identity_rate", s.wrong_identity_rate);
    row("false_alarms_per_1000", s.false_alarms_per_1000);
    row("spurious_per_minute", s.spurious_per_minute);
    row("fix_age_median_s", s.fix_age.median_s);
    row("fix_age_p95_s", s.fix_age.p95_s);
    row("fix_age_max_s", s.fix_age.max_s);
    row("median_px", l.median_px, method.median_px);
    row("p95_px", l.p95_px);
    row("median_percent_d", l.median_percent);
    row("common_median_px", method.common.median_px);
    if (!s.blur.any()) return;
    row("blur_told", static_cast<double>(s.blur.told));
    row("blur_direction_median_deg", s.blur.direction_median_deg);
    row("blur_length_median_percent", s.blur.length_median_percent);
  }

  void share(const JudgedMethod& method, std::size_t which) {
    const ShareScore& score = share_scores()[which];
    row(score.name, method.scores.*score.value, method.shares[which], method.standings[which]);
  }

  void row(std::string_view score, const std::optional<double>& value,
           const std::optional<Interval>& interval = {}, Standing standing = Standing::none) {
    text_ +=
        fmt::format("{},{},{},{},{},{}\n", begin_, score, cell(value), interval ? cell(interval->low) : "",
                    interval ? cell(interval->high) : "", to_string(standing));
  }

  std::string begin_;
  std::string text_ = "protocol,gaps,gate,real_time,latency,by,group,method,score,value,low,high,standing\n";
};

}  // namespace

std::string tables_csv(const std::vector<JudgedTable>& tables) {
  Rows rows;
  for (const JudgedTable& table : tables) rows.of(table);
  return std::move(rows).text();
}

}  // namespace relock
