#include "cli/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

#include "cli/combinations.h"
#include "cli/runs/child.h"
#include "core/compose.h"
#include "core/error.h"
#include "core/random.h"
#include "eval/replay/yardsticks.h"

namespace relock {
namespace {

const std::vector<std::string> kYardsticks{"mute", "still", "linear", "oracle"};

/// Has a method made with these options, so that one out of range is told now and not after an hour. The code
/// of a plug-in may do anything: it is tried in a child.
template <class Entry>
void try_options(const Entry& entry, const Options& options) {
  const auto make = [&](const Tell&) {
    if constexpr (std::is_same_v<Entry, DetectorEntry>) entry.reads(options);
    entry.make(options, 0);
  };
  if (!entry.plugin) return make({});
  constexpr std::chrono::seconds kPatience{60};
  const auto end = run_in_child(make, {.silence = kPatience}).end;
  if (end.kind == ChildEnd::Kind::threw) throw Error(end.what);
  if (end.kind != ChildEnd::Kind::finished)
    throw Error(
        fmt::format("{} of plug-in {} cannot be made: it {}", entry.name, entry.plugin->name, end.what));
}

/// Adds what the method is or is made of; options of a part are told as "kcf.resize".
template <class Entry>
void add_part(ChosenMethod& chosen, const Bound<Entry>& part) {
  try_options(part.entry, part.options);
  const bool whole = chosen.text == part.entry.name || chosen.text.starts_with(part.entry.name + "(");
  const std::string prefix = whole ? "" : part.entry.name + ".";
  for (const auto& [option, value] : part.told) chosen.options[prefix + option] = value;
  chosen.program += part.program;
}

void add_detector(ChosenMethod& chosen, const Bound<DetectorEntry>& detector) {
  add_part(chosen, detector);
  chosen.reads = detector.entry.reads(detector.options);
  chosen.reads_codes = !chosen.reads.empty();
}

void add_tracker(ChosenMethod& chosen, const Bound<TrackerEntry>& tracker) {
  add_part(chosen, tracker);
  chosen.takes_boxes = true;
  chosen.deterministic = tracker.entry.deterministic;
}

TrackerFactory starts_of(const Bound<TrackerEntry>& tracker, std::uint64_t seed) {
  return [tracker, seed](std::uint64_t start) {
    return tracker.entry.make(tracker.options, Random(seed).fork(start).next());
  };
}

ChosenMethod choose_detector(ChosenMethod chosen, const Bound<DetectorEntry>& detector) {
  add_detector(chosen, detector);
  chosen.make = [detector](const Recording&, std::uint64_t seed) {
    return detect_every_frame(detector.entry.make(detector.options, seed));
  };
  return chosen;
}

ChosenMethod choose_tracker(ChosenMethod chosen, const Bound<TrackerEntry>& tracker) {
  add_tracker(chosen, tracker);
  chosen.needs_start = true;
  chosen.make = [tracker](const Recording&, std::uint64_t seed) {
    return track_from_box(starts_of(tracker, seed));
  };
  return chosen;
}

ChosenMethod choose_hybrid(ChosenMethod chosen, const Bound<DetectorEntry>& detector,
                           const Bound<TrackerEntry>& tracker, const HybridOptions& options) {
  add_detector(chosen, detector);
  add_tracker(chosen, tracker);
  chosen.make = [=](const Recording&, std::uint64_t seed) {
    return hybrid(detector.entry.make(detector.options, seed), starts_of(tracker, seed), options);
  };
  return chosen;
}

ChosenMethod choose_guarded(ChosenMethod chosen, const Bound<TrackerEntry>& tracker,
                            const Bound<DetectorEntry>& detector, const GuardedOptions& options) {
  add_detector(chosen, detector);
  add_tracker(chosen, tracker);
  chosen.needs_start = true;
  chosen.make = [=](const Recording&, std::uint64_t seed) {
    return guarded(starts_of(tracker, seed), detector.entry.make(detector.options, seed), options);
  };
  return chosen;
}

ChosenMethod choose_combination(const Methods& methods, const MethodSpec& spec, ChosenMethod chosen) {
  if (is_tracker_combination(spec.name))
    return choose_tracker(std::move(chosen), bound_tracker(methods, spec));
  check_parts(methods, spec);
  const auto& known = combinations();
  const auto info =
      std::find_if(known.begin(), known.end(), [&](const auto& c) { return c.name == spec.name; });
  const Options options(spec.name, info->options, spec.options);
  chosen.options = options.values();
  if (spec.name == "detect")
    return choose_detector(std::move(chosen), bound_detector(methods, spec.parts[0]));
  if (spec.name == "track") return choose_tracker(std::move(chosen), bound_tracker(methods, spec.parts[0]));
  if (spec.name == "hybrid")
    return choose_hybrid(std::move(chosen), bound_detector(methods, spec.parts[0]),
                         bound_tracker(methods, spec.parts[1]), hybrid_options(options));
  return choose_guarded(std::move(chosen), bound_tracker(methods, spec.parts[0]),
                        bound_detector(methods, spec.parts[1]), guarded_options(options));
}

ChosenMethod choose_end_of_scale(const MethodSpec& spec) {
  const Options none(spec.name, {}, spec.options);  // whatever was given is refused
  ChosenMethod chosen{.text = spec.text(), .yardstick = true, .takes_boxes = true};
  chosen.make = [name = spec.name](const Recording& recording, std::uint64_t) {
    return name == "mute" ? mute() : oracle(recording);
  };
  return chosen;
}

}  // namespace

bool is_yardstick(const std::string& name) {
  return std::find(kYardsticks.begin(), kYardsticks.end(), name) != kYardsticks.end();
}

bool ChosenMethod::asked_about(const Target& target) const {
  if (reads.empty()) return true;
  return target.code && std::find(reads.begin(), reads.end(), target.code->family) != reads.end();
}

std::vector<std::string> method_names(const Methods& methods) {
  auto names = methods.detectors.names();
  const auto trackers = methods.trackers.names();
  names.insert(names.end(), trackers.begin(), trackers.end());
  for (const std::string& name : kYardsticks)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  names.insert(names.end(), combination_names().begin(), combination_names().end());
  return names;
}

Error unknown_method(const Methods& methods, const std::string& name) {
  const auto names = method_names(methods);
  return Error(fmt::format("no method is called \"{}\"{}; `relock list` shows all {}", name,
                           did_you_mean(name, names), names.size()));
}

bool is_detection(const Methods& methods, const MethodSpec& spec) {
  return spec.name == "detect" || methods.detectors.find(spec.name);
}

ChosenMethod choose(const Methods& methods, const MethodSpec& spec) {
  if (spec.name == "mute" || spec.name == "oracle") return choose_end_of_scale(spec);
  const ChosenMethod named{.text = spec.text(), .yardstick = is_yardstick(spec.name)};
  if (is_combination(spec.name)) return choose_combination(methods, spec, named);
  if (methods.detectors.find(spec.name)) return choose_detector(named, bound_detector(methods, spec));
  if (methods.trackers.find(spec.name)) return choose_tracker(named, bound_tracker(methods, spec));
  throw unknown_method(methods, spec.name);
}

std::vector<ChosenMethod> yardsticks(const Methods& methods, bool with_start,
                                     const std::vector<ChosenMethod>& chosen) {
  std::vector<ChosenMethod> all;
  for (const std::string& name : kYardsticks) {
    if (std::any_of(chosen.begin(), chosen.end(), [&](const ChosenMethod& c) { return c.text == name; }))
      continue;
    ChosenMethod yardstick = choose(methods, {name, {}});
    if (with_start || !yardstick.needs_start) all.push_back(std::move(yardstick));
  }
  return all;
}

const DetectorEntry& detector_entry(const Methods& methods, const std::string& name) {
  if (const auto* entry = methods.detectors.find(name)) return *entry;
  if (methods.trackers.find(name) || is_yardstick(name) || is_combination(name))
    throw Error(fmt::format("{} is no detector: it cannot look at single pictures", name));
  const auto names = methods.detectors.names();
  throw Error(fmt::format("no detector is called \"{}\"{}; `relock list` shows all {}", name,
                          did_you_mean(name, names), names.size()));
}

}  // namespace relock
