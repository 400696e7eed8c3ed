#include "cli/conformance/conformance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/conformance/checks.h"
#include "cli/conformance/guarded_picture.h"
#include "cli/runs/child.h"
#include "core/nearest.h"

namespace relock {
namespace {

using Kind = CheckResult::Kind;

std::vector<Check> checks_of(const Subject& subject) {
  std::vector<Check> all;
  const auto own = subject.tracker ? tracker_checks() : detector_checks();
  for (const auto& some : {entry_checks(), own, film_checks(), pixel_checks(), session_checks()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

std::vector<Check> chosen_checks(const Subject& subject, const std::optional<std::string>& only) {
  std::vector<Check> all = checks_of(subject);
  if (!only) return all;
  std::vector<std::string> names;
  for (const Check& check : all) {
    if (check.name == *only) return {check};
    names.emplace_back(check.name);
  }
  throw Error(fmt::format("no check of {} is called \"{}\"{}; its checks are {}", subject.name(), *only,
                          did_you_mean(*only, names), fmt::join(names, ", ")));
}

ChildLimits limits_of(const ConformanceOptions& options) {
  return {.silence = options.silence, .memory_bytes = options.memory_bytes};
}

/// Asks the method's code, in a child, whether it takes its options and what codes it reads. A method that
/// does not survive that fails the checks.
void ask_what_it_reads(Subject& subject, const ChildLimits& limits) {
  const ChildResult result = run_in_child(
      [&](const Tell& tell) {
        try {
          session(subject, 0);
          if (!subject.detector) return;
          for (const std::string& family : subject.detector->reads(subject.options))
            if (print_of(family)) return tell("f" + family);
        } catch (const Error& fault) {
          tell(std::string("e") + fault.what());
        }
      },
      limits);
  for (const std::string& message : result.messages) {
    if (message[0] == 'e') throw Error(message.substr(1));
    subject.family = message.substr(1);
  }
}

std::string last_line(std::string text) {
  const auto printable = [](char c) { return static_cast<unsigned char>(c) >= ' '; };
  while (!text.empty() && !printable(text.back())) text.pop_back();
  const auto begin = std::find_if_not(text.rbegin(), text.rend(), printable).base();
  return {begin, text.end()};
}

/// Why a child that did not get to its end did not.
std::string reason_of(const StageReport& report, const ChildEnd& end) {
  const std::string place = report.place.empty() ? "at its very beginning" : report.place;
  if (const std::string touch = wrong_touch(end.tail); !touch.empty()) return place + ": " + touch;
  const std::string said = end.kind == ChildEnd::Kind::crashed ? last_line(end.tail) : "";
  return place + ": " + end.what + (said.empty() ? "" : fmt::format(", after saying \"{}\"", said));
}

/// A library's words may come in several lines.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

CheckResult result_of(const Check& check, const StageReport& report, const ChildEnd& end) {
  const std::string name(check.name);
  if (report.reason) return {name, Kind::failed, one_line(*report.reason)};
  if (report.not_asked) return {name, Kind::not_asked, *report.not_asked};
  // What the method's threads or its end do after the check has passed counts too.
  if (end.kind == ChildEnd::Kind::finished && report.note) return {name, Kind::passed, *report.note};
  return {name, Kind::failed, one_line(reason_of(report, end))};
}

void play(const Check& check, const Subject& subject, const MemoryLimits& limits, Stage& stage) {
  try {
    stage.passed(check.work(subject, limits, stage));
  } catch (const Broken& broken) {
    stage.broken(broken.what());
  } catch (const NotAsked& not_asked) {
    stage.not_asked(not_asked.what());
  }
}

CheckResult in_a_process(const Check& check, const Subject& subject, const ConformanceOptions& options,
                         bool again, std::vector<std::string>& answers) {
  const ChildResult child = run_in_child(
      [&](const Tell& tell) {
        Stage stage(tell, again);
        play(check, subject, {.frames = options.frames, .budget = options.budget}, stage);
      },
      limits_of(options));
  StageReport report = read_report(child.messages);
  answers = std::move(report.answers);
  return result_of(check, report, child.end);
}

CheckResult make(const Check& check, const Subject& subject, const ConformanceOptions& options) {
  std::vector<std::string> first, second;
  const CheckResult result = in_a_process(check, subject, options, false, first);
  if (!check.twice || result.kind != Kind::passed) return result;
  CheckResult again = in_a_process(check, subject, options, true, second);
  if (again.kind != Kind::passed) return again;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
    if (first[i] != second[i])
      return {result.check, Kind::failed,
              fmt::format("with the same seed once \"{}\" and once \"{}\"", first[i], second[i])};
  return again;
}

/// A failure that the method's entry admits is told as such.
CheckResult admitted(CheckResult result, const Subject& subject) {
  if (result.kind != Kind::failed || !subject.tracker) return result;
  for (const KnownFault& fault : subject.tracker->known_faults)
    if (fault.check == result.check) return {result.check, Kind::known, fault.why};
  return result;
}

}  // namespace

std::string_view to_string(CheckResult::Kind kind) {
  constexpr std::string_view names[] = {"passed", "failed", "not asked", "known"};
  return names[static_cast<std::size_t>(kind)];
}

std::size_t Conformance::count(CheckResult::Kind wanted) const {
  return static_cast<std::size_t>(
      std::count_if(checks.begin(), checks.end(), [&](const CheckResult& c) { return c.kind == wanted; }));
}

Conformance check_method(const Methods& methods, const MethodSpec& spec, const ConformanceOptions& options,
                         const OnCheck& on_check) {
  Subject subject = subject_called(methods, spec);
  const auto checks = chosen_checks(subject, options.only);
  ask_what_it_reads(subject, limits_of(options));
  Conformance conformance{subject.text, subject.tracker ? "tracker" : "detector", {}};
  for (const Check& check : checks) {
    conformance.checks.push_back(admitted(make(check, subject, options), subject));
    on_check(conformance);
  }
  return conformance;
}

}  // namespace relock
