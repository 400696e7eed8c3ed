#include "cli/scores/print.h"

#include <fmt/format.h>

#include <algorithm>

namespace relock {
namespace {

/// Whether anything could be hit there.
bool has_frames(const ScoreTable& table) {
  return std::any_of(table.methods.begin(), table.methods.end(),
                     [](const MethodPool& method) { return method.tally.sum.could_hit > 0; });
}

bool has_costs(const ScoreTable& table) {
  return std::any_of(table.methods.begin(), table.methods.end(),
                     [](const MethodPool& method) { return !method.costs.empty(); });
}

bool tells_blur(const JudgedTable& judged) {
  return std::any_of(judged.methods.begin(), judged.methods.end(),
                     [](const JudgedMethod& method) { return method.scores.blur.any(); });
}

class Printer {
 public:
  explicit Printer(TableFormat format) : format_(format) {}

  /// Those of the same conditions, from `begin` on; returns their end.
  std::size_t print(const std::vector<JudgedTable>& all, std::size_t begin) {
    std::size_t end = begin;
    while (end < all.size() && all[end].table.conditions == all[begin].table.conditions) ++end;
    const auto pooled = std::find_if(all.begin() + offset(begin), all.begin() + offset(end),
                                     [](const auto& t) { return t.table.grouping == Grouping::none; });
    title(pooled->table);
    print_groups(all, begin, end);
    if (end - begin == 1 || pooled->table.targets() > 1) print_one(*pooled, "all targets pooled");
    if (has_costs(pooled->table)) {
      subtitle("what it cost, all targets together");
      fmt::print("{}", cost_table(*pooled).in(format_));
    }
    for (std::size_t i = 0; i < pooled->methods.size(); ++i)
      for (const std::string& remark : remarks(*pooled, i)) print_remark(remark);
    return end;
  }

 private:
  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  void title(const ScoreTable& table) {
    std::string text = heading(table);
    std::replace(text.begin(), text.end(), '\n', ' ');
    fmt::print("{}{}{}\n", first_ ? "" : "\n", mark("", "## "), text);
    first_ = false;
  }

  void print_remark(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    fmt::print("{}{}\n", mark("  ", "- "), text);
  }

  void print_groups(const std::vector<JudgedTable>& all, std::size_t begin, std::size_t end) {
    std::vector<const JudgedTable*> bins;
    for (std::size_t i = begin; i < end; ++i) {
      const ScoreTable& table = all[i].table;
      if (table.grouping == Grouping::none) continue;
      if (table.grouping == Grouping::blur || table.grouping == Grouping::gap) {
        if (has_frames(table)) bins.push_back(&all[i]);
      } else {
        print_one(all[i], fmt::format("{} {}", to_string(table.grouping), table.group));
      }
    }
    if (bins.empty()) return;
    subtitle(bins.front()->table.grouping == Grouping::blur ? "recognition by length of the true blur"
                                                            : "recognition by the gap before the frame");
    fmt::print("{}", bins_table(bins).in(format_));
  }

  void print_one(const JudgedTable& judged, const std::string& what) {
    subtitle(what);
    fmt::print("{}\n{}", keeping_table(judged).in(format_), exactness_table(judged).in(format_));
    if (tells_blur(judged)) fmt::print("\n{}", blur_table(judged).in(format_));
    if (!judged.table.conditions.real_time.empty())
      fmt::print("\n{}", real_time_table(judged.table).in(format_));
  }

  void subtitle(const std::string& text) {
    fmt::print("\n{}{}\n", mark("  ", "### "), text);
    if (format_ == TableFormat::markdown) fmt::print("\n");
  }

  /// What a line begins with; in LaTeX it is a comment.
  std::string_view mark(std::string_view text, std::string_view markdown) const {
    return format_ == TableFormat::text ? text : format_ == TableFormat::markdown ? markdown : "% ";
  }

  TableFormat format_;
  bool first_ = true;
};

}  // namespace

std::vector<std::string> remarks(const JudgedTable& judged, std::size_t i) {
  const ScoreTable& table = judged.table;
  const Scores& s = judged.methods[i].scores;
  const MethodPool& method = table.methods[i];
  std::vector<std::string> all;
  std::size_t most = 0;
  for (const MethodPool& other : table.methods) most = std::max(most, other.scored_on.size());
  if (!method.failures.empty())
    all.push_back(fmt::format("{} failed on frame {}: {}; {} visible frames after it count as Misses",
                              method.method, method.failures[0].frame, method.failures[0].what, s.failed));
  if (s.spurious > 0) all.push_back(fmt::format("{}: {} spurious sightings", method.method, s.spurious));
  if (s.uncoded > 0) all.push_back(fmt::format("{}: {} Hits without a code", method.method, s.uncoded));
  if (!method.deterministic)
    all.push_back(fmt::format("{} answers differently from run to run: its scores are of {}", method.method,
                              method.runs == 1 ? "one run" : fmt::format("{} runs", method.runs)));
  if (method.targets() < table.targets())
    all.push_back(
        fmt::format("{} is scored on {} of {} targets: compare it with others in --by target or recording",
                    method.method, method.targets(), table.targets()));
  else if (method.scored_on.size() < most)
    all.push_back(fmt::format("{} was shown fewer patterns of frames than others (fewer seeds or starts)",
                              method.method));
  return all;
}

void print_tables(const std::vector<JudgedTable>& tables, TableFormat format,
                  const std::vector<std::string>& ends) {
  Printer printer(format);
  for (std::size_t i = 0; i < tables.size();) i = printer.print(tables, i);
  if (format != TableFormat::text || tables.empty()) return;
  for (const std::string& end : ends) fmt::print("  {}\n", end);
  fmt::print("{}", table_footnote());
  if (std::any_of(tables.begin(), tables.end(), tells_blur)) fmt::print("{}", blur_footnote());
  if (std::any_of(tables.begin(), tables.end(),
                  [](const JudgedTable& t) { return !t.table.conditions.real_time.empty(); }))
    fmt::print("{}", real_time_footnote());
}

}  // namespace relock
