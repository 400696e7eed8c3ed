#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/catalogue.h"
#include "core/compose.h"

namespace relock {

/// What `relock list` tells of a combination; core/compose.h says what it does.
struct CombinationInfo {
  std::string name;
  std::string takes;  ///< its methods: "a detector and then a tracker"
  std::string sentence;
  std::vector<OptionInfo> options;
};
const std::vector<CombinationInfo>& combinations();

/// A tracker or a detector with its options, as it was asked for.
template <class Entry>
struct Bound {
  Entry entry;  ///< of a combination its own: it makes the parts, too
  Options options;
  std::map<std::string, std::string> told = {};  ///< all options, those of parts as "kcf.resize"
  std::string program = {};                      ///< fingerprints of the plug-ins in it
};

/// One from the registry, or a combination that is a tracker itself: gap-aware, blur-predict. Nothing of it is
/// made. Throws Error for an unknown name or option, and for what is no tracker.
Bound<TrackerEntry> bound_tracker(const Methods& methods, const MethodSpec& spec);
/// Throws Error likewise, for what is no detector.
Bound<DetectorEntry> bound_detector(const Methods& methods, const MethodSpec& spec);

/// Whether the combination is a tracker, and may stand where a tracker is needed.
bool is_tracker_combination(const std::string& name);

/// The tracker that a method is or has in it, however deep: kcf of kcf, track(kcf) and guarded(gap-aware(kcf),ring);
/// nothing of a combination without one. What is no combination is taken for one.
std::optional<MethodSpec> tracker_in(const MethodSpec& spec);
/// The combination with `name` in the place of the tracker in it: "guarded(gap-aware(T),ring)".
MethodSpec with_tracker(const MethodSpec& spec, const std::string& name);

/// "gap-aware needs a tracker; ring is a detector": throws Error unless the parts are those that the
/// combination takes.
void check_parts(const Methods& methods, const MethodSpec& spec);

HybridOptions hybrid_options(const Options& given);
GuardedOptions guarded_options(const Options& given);

}  // namespace relock
