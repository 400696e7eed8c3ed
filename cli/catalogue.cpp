#include "cli/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

#include "cli/runs/child.h"
#include "core/compose.h"
#include "core/error.h"
#include "core/random.h"
#include "eval/replay/yardsticks.h"

namespace relock {
namespace {

const std::vector<std::string> kYardsticks{"mute", "still", "linear", "oracle"};

ChosenMethod base(const MethodSpec& spec, const Options& options) {
  ChosenMethod chosen;
  chosen.text = spec.text();
  chosen.options = options.values();
  chosen.yardstick = is_yardstick(spec.name);
  return chosen;
}

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

ChosenMethod choose_detector(const DetectorEntry& entry, const MethodSpec& spec) {
  const Options options(entry.name, entry.options, spec.options);
  try_options(entry, options);
  ChosenMethod chosen = base(spec, options);
  chosen.reads = entry.reads(options);
  chosen.reads_codes = !chosen.reads.empty();
  if (entry.plugin) chosen.program = entry.plugin->fingerprint;
  chosen.make = [&entry, options](const Recording&, std::uint64_t seed) {
    return detect_every_frame(entry.make(options, seed));
  };
  return chosen;
}

ChosenMethod choose_tracker(const TrackerEntry& entry, const MethodSpec& spec) {
  const Options options(entry.name, entry.options, spec.options);
  try_options(entry, options);
  ChosenMethod chosen = base(spec, options);
  chosen.needs_start = true;
  chosen.takes_boxes = true;
  chosen.deterministic = entry.deterministic;
  if (entry.plugin) chosen.program = entry.plugin->fingerprint;
  chosen.make = [&entry, options](const Recording&, std::uint64_t seed) {
    return track_from_box([&entry, options, seed](std::uint64_t start) {
      return entry.make(options, Random(seed).fork(start).next());
    });
  };
  return chosen;
}

ChosenMethod choose_end_of_scale(const MethodSpec& spec) {
  ChosenMethod chosen = base(spec, Options(spec.name, {}, spec.options));
  chosen.takes_boxes = true;
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
  return names;
}

ChosenMethod choose(const Methods& methods, const MethodSpec& spec) {
  if (const auto* entry = methods.detectors.find(spec.name)) return choose_detector(*entry, spec);
  if (const auto* entry = methods.trackers.find(spec.name)) return choose_tracker(*entry, spec);
  if (spec.name == "mute" || spec.name == "oracle") return choose_end_of_scale(spec);
  const auto names = method_names(methods);
  throw Error(fmt::format("no method is called \"{}\"{}; `relock list` shows all {}", spec.name,
                          did_you_mean(spec.name, names), names.size()));
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
  if (methods.trackers.find(name) || is_yardstick(name))
    throw Error(fmt::format("{} is no detector: it cannot look at single pictures", name));
  const auto names = methods.detectors.names();
  throw Error(fmt::format("no detector is called \"{}\"{}; `relock list` shows all {}", name,
                          did_you_mean(name, names), names.size()));
}

}  // namespace relock
