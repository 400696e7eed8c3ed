// What cli/compare/changes.h tells, for people.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/compare/changes.h"
#include "cli/table.h"
#include "eval/loss_text.h"

namespace relock {
namespace {

constexpr std::size_t kNamedRecordings = 4;  // more are counted

std::string heading(const ConditionsChange& group) {
  const std::string recordings = group.recordings.size() > kNamedRecordings
                                     ? fmt::format("{} recordings", group.recordings.size())
                                     : fmt::format("{}", fmt::join(group.recordings, ", "));
  return fmt::format("{}, {}, {}\n", recordings, group.gaps == "none" ? "as recorded" : "gaps " + group.gaps,
                     to_string(static_cast<const PairedConditions&>(group)));
}

// Scores

int decimals_of(ComparedScore score) {
  switch (score) {
    case ComparedScore::losses:
      return 0;
    case ComparedScore::losses_per_minute:
      return 1;
    case ComparedScore::error_px:
      return 2;
    default:
      return 3;
  }
}

std::string spoken_name(ComparedScore score) {
  std::string name(name_of(score));
  std::replace(name.begin(), name.end(), '-', ' ');
  return name;
}

/// "kcf", or "mosse in A, kcf in B".
std::string name_of(const MethodChange& method) {
  if (method.method == method.method_in_b) return method.method;
  return fmt::format("{} in A, {} in B", method.method, method.method_in_b);
}

std::string mark(int verdict) { return verdict < 0 ? "worse" : verdict > 0 ? "better" : ""; }

std::string interval_cell(ComparedScore which, const ScoreChange& score) {
  if (!has_interval(which)) return "";
  if (!score.interval) return "n/a";
  const int decimals = decimals_of(which);
  return fmt::format("[{}, {}]", signed_cell(score.interval->low, decimals),
                     signed_cell(score.interval->high, decimals));
}

/// An error below the accuracy of the labels says nothing, and neither does its difference.
bool below_labels(ComparedScore which, const MethodChange& method) {
  const ScoreChange& score = method[which];
  const double least = 2 * method.label_sigma_px;
  return which == ComparedScore::error_px && score.before && (*score.before < least || *score.after < least);
}

void add_score(Table& table, ComparedScore which, const MethodChange& method) {
  const ScoreChange& score = method[which];
  const int decimals = decimals_of(which);
  if (below_labels(which, method)) {
    const double least = 2 * method.label_sigma_px;
    const auto px_cell = [&](const std::optional<double>& px) {
      return *px < least ? fmt::format("<{:.2f}", least) : cell(px, decimals);
    };
    return table.add(
        {"  " + spoken_name(which), px_cell(score.before), px_cell(score.after), "n/a", "n/a", ""});
  }
  table.add({"  " + spoken_name(which), cell(score.before, decimals), cell(score.after, decimals),
             signed_cell(score.difference, decimals), interval_cell(which, score),
             mark(verdict_on(which, score.interval))});
}

std::string scores_text(const ConditionsChange& group) {
  Table table({"", "A", "B", "B - A", "95 % interval", ""});
  bool any = false;
  for (const MethodChange& method : group.methods) {
    if (method.same()) continue;
    any = true;
    table.add({name_of(method), "", "", "", "", ""});
    for (std::size_t i = 0; i < kComparedScores; ++i) add_score(table, static_cast<ComparedScore>(i), method);
  }
  return any ? "\n" + table.text(2) : "";
}

std::string same_text(const ConditionsChange& group) {
  std::vector<std::string> same;
  for (const MethodChange& method : group.methods)
    if (method.same()) same.push_back(name_of(method));
  if (same.empty()) return "";
  return fmt::format("\n  the same answers in A and B: {}\n", fmt::join(same, ", "));
}

// Losses

std::string counts(const MethodChange& method) {
  std::vector<std::string> parts;
  for (const LossFate fate : {LossFate::appeared, LossFate::gone, LossFate::moved, LossFate::kept})
    if (const std::size_t n = method.count(fate); n > 0)
      parts.push_back(fmt::format("{} {}", n, to_string(fate)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// What B has otherwise: "begins 0.60 s later, lasts 0.20 s longer, is Silent instead of Declared".
std::string otherwise(const LossChange& change) {
  std::vector<std::string> parts;
  const auto by = [&](Duration d, const std::string& verb, const char* more, const char* less) {
    if (d != Duration{0})
      parts.push_back(
          fmt::format("{} {:.2f} s {}", verb, std::abs(seconds(d)), d > Duration{0} ? more : less));
  };
  by(change.later, "begins", "later", "earlier");
  by(change.longer, "lasts", "longer", "less");
  if (change.before->kind != change.after->kind)
    parts.push_back(
        fmt::format("is {} instead of {}", to_string(change.after->kind), to_string(change.before->kind)));
  return joined(parts);
}

std::string line_of(const ChangedLoss& loss) {
  const LossChange& change = loss.change;
  const bool both = change.before && change.after;
  return fmt::format(
      "    {:<6}{}: {}{}\n", to_string(change.fate), loss.where, loss.text,
      both && !otherwise(change).empty() ? fmt::format(" (in B it {})", otherwise(change)) : "");
}

std::string losses_text(const MethodChange& method) {
  const auto tells = [](const ChangedLoss& loss) {
    return loss.change.fate != LossFate::kept || loss.change.differs();
  };
  if (std::none_of(method.losses.begin(), method.losses.end(), tells)) return "";
  std::string text = fmt::format("\n  losses of {}: {}\n", name_of(method), counts(method));
  for (const ChangedLoss& loss : method.losses)
    if (tells(loss)) text += line_of(loss);
  return text;
}

std::string group_text(const ConditionsChange& group) {
  std::string text = heading(group) + scores_text(group);
  for (const MethodChange& method : group.methods)
    if (!method.deterministic && !method.same())
      text += fmt::format("  {} answers differently from run to run: its differences hold that, too\n",
                          name_of(method));
  text += same_text(group);
  for (const MethodChange& method : group.methods) text += losses_text(method);
  return text;
}

bool any_differs(const FolderChange& change) {
  return std::any_of(change.groups.begin(), change.groups.end(), [](const ConditionsChange& group) {
    return std::any_of(group.methods.begin(), group.methods.end(),
                       [](const MethodChange& method) { return !method.same(); });
  });
}

}  // namespace

std::string changes_text(const FolderChange& change, const FolderNames& names) {
  std::string text = fmt::format("A: {}\nB: {}\n", names.a, names.b);
  for (const ConditionsChange& group : change.groups) text += "\n" + group_text(group);
  const bool rest = !change.only_in_a.empty() || !change.only_in_b.empty() || !change.left_out.empty();
  if (rest) text += "\n";
  for (const std::string& what : change.only_in_a) text += fmt::format("  only in A: {}\n", what);
  for (const std::string& what : change.only_in_b) text += fmt::format("  only in B: {}\n", what);
  for (const std::string& what : change.left_out) text += fmt::format("  left out: {}\n", what);
  if (any_differs(change))
    text +=
        "\n  Differences are B - A on the same frames; worse, better: the interval holds no zero. error px: "
        "medians over\n"
        "  Hits of both on the same frame, and the median of their differences there.\n";
  return text;
}

}  // namespace relock
