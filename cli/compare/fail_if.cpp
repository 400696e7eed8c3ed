#include "cli/compare/fail_if.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

std::vector<std::string> metrics() {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < kComparedScores; ++i) all.emplace_back(name_of(static_cast<ComparedScore>(i)));
  return all;
}

/// Reads a condition from left to right. A method's name may hold anything but a colon at its end.
class ConditionReader {
 public:
  explicit ConditionReader(std::string_view text) : text_(text) {}

  FailCondition read() {
    FailCondition condition{std::string(text_), method(), metric(), rises(), more_than(), surely()};
    if (condition.surely && !has_interval(condition.score))
      fail("a count of losses has no interval to be sure by; losses-per-minute has");
    skip_spaces();
    if (at_ < text_.size())
      fail_here("a condition ends after the number, or after \"surely\"; shares are of 1: 0.02, not 2 %");
    return condition;
  }

 private:
  std::optional<std::string> method() {
    const std::size_t colon = text_.rfind(':');
    if (colon == std::string_view::npos) return {};
    skip_spaces();
    std::size_t last = colon;
    while (last > at_ && text_[last - 1] == ' ') --last;
    if (last <= at_) fail_here("a method's name belongs before the colon");
    const std::string name(text_.substr(at_, last - at_));
    at_ = colon + 1;
    return name;
  }

  ComparedScore metric() {
    std::string name(word("a metric belongs here: " + fmt::format("{}", fmt::join(metrics(), ", "))));
    std::replace(name.begin(), name.end(), '_', '-');
    const auto all = metrics();
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end())
      fail(fmt::format("no metric is called \"{}\"{}; there are {}", name, did_you_mean(name, all),
                       fmt::join(all, ", ")));
    return static_cast<ComparedScore>(found - all.begin());
  }

  bool rises() {
    const std::string_view way = word("\"drops\" or \"rises\" belongs here");
    if (way != "drops" && way != "rises")
      fail(fmt::format("\"drops\" or \"rises\" belongs here, not \"{}\"", way));
    return way == "rises";
  }

  double more_than() {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != '>') fail_here("\">\" and a number belong here");
    ++at_;
    skip_spaces();
    word_ = at_;
    double value = 0;
    const auto [end, fault] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (fault != std::errc() || !std::isfinite(value) || value < 0)
      fail("a number from 0 belongs here, such as 0.02");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  bool surely() {
    skip_spaces();
    constexpr std::string_view kSurely = "surely";
    if (text_.substr(at_) == kSurely || text_.substr(at_).starts_with("surely ")) {
      word_ = at_;
      at_ += kSurely.size();
      return true;
    }
    return false;
  }

  std::string_view word(std::string_view wanted) {
    skip_spaces();
    word_ = at_;
    while (at_ < text_.size() && text_[at_] != ' ' && text_[at_] != '>') ++at_;
    if (at_ == word_) fail(wanted);
    return text_.substr(word_, at_ - word_);
  }

  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  [[noreturn]] void fail_here(std::string_view sentence) {
    word_ = at_;
    fail(sentence);
  }
  /// Points at the word that was read last.
  [[noreturn]] void fail(std::string_view sentence) const {
    throw Error(fmt::format("--fail-if, character {}: {}\n  {}\n  {:>{}}", word_ + 1, sentence, text_, '^',
                            word_ + 1));
  }

  std::string_view text_;
  std::size_t at_ = 0, word_ = 0;
};

void check_method(const FailCondition& condition, const FolderChange& change) {
  std::vector<std::string> names;
  for (const ConditionsChange& group : change.groups)
    for (const MethodChange& method : group.methods)
      if (std::find(names.begin(), names.end(), method.method) == names.end()) names.push_back(method.method);
  if (!condition.method || std::find(names.begin(), names.end(), *condition.method) != names.end()) return;
  throw Error(fmt::format("--fail-if '{}': no method {} is in both folders{}; there are {}", condition.text,
                          *condition.method, did_you_mean(*condition.method, names), fmt::join(names, ", ")));
}

/// How far the score went in the direction that is asked about; by its interval the end that is surest.
std::optional<double> moved(const FailCondition& condition, const ScoreChange& score) {
  if (!condition.surely) {
    if (!score.difference) return {};
    return condition.rises ? *score.difference : -*score.difference;
  }
  if (!score.interval) return {};
  return condition.rises ? score.interval->low : -score.interval->high;
}

std::string place(const MethodChange& method, const ConditionsChange& group) {
  return fmt::format("{}, {}, {}", method.method, group.gaps == "none" ? "as recorded" : "gaps " + group.gaps,
                     spoken(group.showing));
}

}  // namespace

FailCondition parse_fail_if(std::string_view text) { return ConditionReader(text).read(); }

Finding check(const FailCondition& condition, const FolderChange& change) {
  check_method(condition, change);
  Finding finding{condition, {}, {}, {}};
  for (const ConditionsChange& group : change.groups)
    for (const MethodChange& method : group.methods) {
      if (condition.method && *condition.method != method.method) continue;
      const ScoreChange& score = method[condition.score];
      if (score.before.has_value() != score.after.has_value())
        finding.unknown.push_back(fmt::format("{}: {} is n/a in {}", place(method, group),
                                              name_of(condition.score), score.before ? "B" : "A"));
      if (condition.surely && score.difference && *score.difference != 0 && !score.interval)
        finding.unsure.push_back(place(method, group));
      const auto by = moved(condition, score);
      if (by && *by > condition.by)
        finding.because.push_back(fmt::format("{}: {} {} by {}{:.4g}", place(method, group),
                                              name_of(condition.score), condition.rises ? "rises" : "drops",
                                              condition.surely ? "at least " : "", *by));
    }
  return finding;
}

}  // namespace relock
