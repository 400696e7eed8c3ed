#include "cli/combinations.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "trackers/patch_blur.h"
#include "trackers/patch_searcher.h"

namespace relock {
namespace {

enum class Part : std::uint8_t { detector, tracker };

struct Combination {
  CombinationInfo info;
  std::vector<Part> parts;
  std::size_t least_parts;
  bool tracker = false;  // what it makes is one
};

std::vector<OptionInfo> gap_option_list() {
  const GapOptions d;
  return {
      {"margin", fmt::format("{}", d.margin), "",
       "correlation by which another place must be more alike than the old one; for trackers that take no "
       "hints"},
      {"rate_hz", "learned", "Hz", "nominal rate; learned: from the frames so far, from the third on"},
      {"spread", fmt::format("{}", d.spread), "",
       "uncertainty of the predicted place for each missing period, in sizes of the target"}};
}

std::vector<OptionInfo> blur_option_list() {
  auto options = gap_option_list();
  options.insert(options.begin(),
                 {"exposure_ms", "learned", "ms", "exposure time; learned: from blur and motion so far"});
  return options;
}

std::vector<OptionInfo> hybrid_option_list() {
  const HybridOptions d;
  return {{"doubt", fmt::format("{}", d.doubt), "", "confidence below which the tracker is not believed"},
          {"every", fmt::format("{}", d.every), "",
           "frames from one look of the detector to the next while nothing is in doubt"},
          {"patience_s", fmt::format("{}", d.patience_s), "s",
           "how long a target whose box nobody gave is followed without being detected"}};
}

std::vector<OptionInfo> guarded_option_list() {
  const GuardedOptions d;
  return {{"apart", fmt::format("{}", d.apart), "",
           "distance from which a detection corrects the tracker, in sizes of the target"},
          {"doubt", fmt::format("{}", d.doubt), "", "confidence below which the detector looks at once"},
          {"every", fmt::format("{}", d.every), "",
           "frames from one look of the detector to the next while nothing is in doubt"},
          {"patience_s", fmt::format("{}", d.patience_s), "s",
           "how long the target may go unconfirmed before it is lost"}};
}

/// In the order of combination_names().
const std::vector<Combination>& table() {
  constexpr Part D = Part::detector, T = Part::tracker;
  static const std::vector<Combination> all{
      {{"detect", "a detector", "detection in every frame: what a detector's name alone means", {}}, {D}, 1},
      {{"track", "a tracker", "tracking from the given box: what a tracker's name alone means", {}}, {T}, 1},
      {{"hybrid", "a detector and then a tracker",
        "detects, and tracks from the last detection where there is none", hybrid_option_list()},
       {D, T},
       2},
      {{"guarded", "a tracker and then a detector",
        "tracks; the detector confirms, corrects, or declares a loss", guarded_option_list()},
       {T, D},
       2},
      {{"gap-aware", "a tracker", "after a gap the tracker looks where constant velocity took the target",
        gap_option_list()},
       {T},
       1,
       true},
      {{"blur-predict", "a tracker and then, if wanted, a detector",
        "likewise, with the blur as speedometer: as the tracker, the detector or the look tells it",
        blur_option_list()},
       {T, D},
       1,
       true}};
  return all;
}

const Combination& combination(const std::string& name) {
  return *std::find_if(table().begin(), table().end(),
                       [&](const Combination& c) { return c.info.name == name; });
}

/// "a tracker", "a detector", or why it is neither. Throws Error for an unknown name.
std::string kind_of(const Methods& methods, const std::string& name) {
  if (is_combination(name)) return is_tracker_combination(name) ? "a tracker" : "a whole method of its own";
  if (methods.detectors.find(name)) return "a detector";
  if (methods.trackers.find(name)) return "a tracker";
  if (is_yardstick(name)) return "an end of the scale";
  throw unknown_method(methods, name);
}

GapOptions gap_options(const Options& given) {
  GapOptions options{.spread = given.number("spread", 0, 10), .margin = given.number("margin", 0, 2)};
  if (given.word("rate_hz") != "learned") options.period_s = 1 / given.number("rate_hz", 0.01, 100000);
  return options;
}

GapOptions blur_options(const Options& given) {
  GapOptions options = gap_options(given);
  if (given.word("exposure_ms") != "learned")
    options.exposure_s = given.number("exposure_ms", 0.001, 10000) / 1e3;
  return options;
}

/// Tells the options and the plug-in of a part as the whole's.
template <class Whole, class Entry>
void absorb(Bound<Whole>& whole, const Bound<Entry>& part) {
  for (const auto& [option, value] : part.told) whole.told[part.entry.name + "." + option] = value;
  whole.program += part.program;
  if (!whole.entry.plugin) whole.entry.plugin = part.entry.plugin;
}

/// The first start has the seed that the tracker alone would have.
TrackerFactory factory_of(const Bound<TrackerEntry>& tracker, std::uint64_t seed) {
  return [tracker, seed](std::uint64_t start) {
    return tracker.entry.make(tracker.options, start == 0 ? seed : Random(seed).fork(start).next());
  };
}

std::unique_ptr<Tracker> made(const std::string& name, const Bound<TrackerEntry>& tracker,
                              const std::optional<Bound<DetectorEntry>>& detector, const Options& options,
                              std::uint64_t seed) {
  const Hints hints = tracker.entry.honours_expect ? Hints::honoured : Hints::ignored;
  const TrackerFactory factory = factory_of(tracker, seed);
  if (name == "gap-aware") return gap_aware(factory, hints, patch_searcher(), gap_options(options));
  const BlurMeter meter =
      detector ? blur_of_detections(detector->entry.make(detector->options, seed)) : patch_blur();
  return blur_predict(factory, hints, patch_searcher(), meter, blur_options(options));
}

Bound<TrackerEntry> tracker_combination(const Methods& methods, const MethodSpec& spec) {
  check_parts(methods, spec);
  const CombinationInfo& info = combination(spec.name).info;
  const auto tracker = bound_tracker(methods, spec.parts[0]);
  std::optional<Bound<DetectorEntry>> detector;
  if (spec.parts.size() > 1) detector = bound_detector(methods, spec.parts[1]);
  Bound<TrackerEntry> bound{{.name = spec.name,
                             .sentence = info.sentence,
                             .options = info.options,
                             .deterministic = tracker.entry.deterministic,
                             .honours_expect = tracker.entry.honours_expect,
                             .known_faults = tracker.entry.known_faults,
                             .make = {}},
                            Options(spec.name, info.options, spec.options)};
  bound.told = bound.options.values();
  absorb(bound, tracker);
  if (detector) absorb(bound, *detector);
  bound.entry.make = [name = spec.name, tracker, detector](const Options& options, std::uint64_t seed) {
    return made(name, tracker, detector, options, seed);
  };
  return bound;
}

/// Which part of a combination the tracker is; nothing: none.
std::optional<std::size_t> tracker_place(const MethodSpec& spec) {
  const std::vector<Part>& parts = combination(spec.name).parts;
  for (std::size_t p = 0; p < std::min(parts.size(), spec.parts.size()); ++p)
    if (parts[p] == Part::tracker) return p;
  return std::nullopt;
}

template <class Entry>
Bound<Entry> bound_entry(const Entry& entry, const MethodSpec& spec) {
  Bound<Entry> bound{entry, Options(entry.name, entry.options, spec.options)};
  bound.told = bound.options.values();
  if (entry.plugin) bound.program = entry.plugin->fingerprint;
  return bound;
}

}  // namespace

const std::vector<CombinationInfo>& combinations() {
  static const std::vector<CombinationInfo> all = [] {
    std::vector<CombinationInfo> infos;
    for (const Combination& c : table()) infos.push_back(c.info);
    return infos;
  }();
  return all;
}

bool is_tracker_combination(const std::string& name) {
  return is_combination(name) && combination(name).tracker;
}

std::optional<MethodSpec> tracker_in(const MethodSpec& spec) {
  if (!is_combination(spec.name)) return spec;
  const auto place = tracker_place(spec);
  return place ? tracker_in(spec.parts[*place]) : std::nullopt;
}

MethodSpec with_tracker(const MethodSpec& spec, const std::string& name) {
  if (!is_combination(spec.name)) return {name};
  MethodSpec changed = spec;
  if (const auto place = tracker_place(spec)) changed.parts[*place] = with_tracker(spec.parts[*place], name);
  return changed;
}

void check_parts(const Methods& methods, const MethodSpec& spec) {
  const Combination& wanted = combination(spec.name);
  for (std::size_t p = 0; p < std::min(spec.parts.size(), wanted.parts.size()); ++p) {
    const std::string kind = kind_of(methods, spec.parts[p].name);
    if (kind != (wanted.parts[p] == Part::detector ? "a detector" : "a tracker"))
      throw Error(
          fmt::format("{} needs {}; {} is {}", spec.name, wanted.info.takes, spec.parts[p].text(), kind));
  }
  if (spec.parts.size() < wanted.least_parts || spec.parts.size() > wanted.parts.size())
    throw Error(fmt::format("{} needs {}; {} has {} method{}", spec.name, wanted.info.takes, spec.text(),
                            spec.parts.size(), spec.parts.size() == 1 ? "" : "s"));
}

Bound<TrackerEntry> bound_tracker(const Methods& methods, const MethodSpec& spec) {
  if (is_tracker_combination(spec.name)) return tracker_combination(methods, spec);
  if (const auto* entry = methods.trackers.find(spec.name)) return bound_entry(*entry, spec);
  throw Error(fmt::format("{} is {}, no tracker", spec.name, kind_of(methods, spec.name)));
}

Bound<DetectorEntry> bound_detector(const Methods& methods, const MethodSpec& spec) {
  if (const auto* entry = methods.detectors.find(spec.name)) return bound_entry(*entry, spec);
  throw Error(fmt::format("{} is {}, no detector", spec.name, kind_of(methods, spec.name)));
}

HybridOptions hybrid_options(const Options& given) {
  return {.doubt = given.number("doubt", 0, 1),
          .every = given.whole("every", 1, 100000),
          .patience_s = given.number("patience_s", 0, 1e6)};
}

GuardedOptions guarded_options(const Options& given) {
  return {.every = given.whole("every", 1, 100000),
          .doubt = given.number("doubt", 0, 1),
          .patience_s = given.number("patience_s", 0, 1e6),
          .apart = given.number("apart", 0, 100)};
}

}  // namespace relock
