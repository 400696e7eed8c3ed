#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/method_spec.h"
#include "cli/program.h"
#include "core/error.h"
#include "core/method.h"
#include "core/recording.h"

namespace relock {

/// A method that was asked for, its name found and its options checked.
struct ChosenMethod {
  std::string text;                                 ///< as it would be typed; names its results
  std::map<std::string, std::string> options = {};  ///< all of them, defaults too
  bool yardstick = false;
  bool needs_start = false;  ///< without a box it never answers: not for protocol detect
  bool takes_boxes = false;  ///< as Method has it
  bool reads_codes = false;
  bool deterministic = true;
  std::string program = {};             ///< fingerprint of the plug-in it comes from; empty: built in
  std::vector<std::string> reads = {};  ///< families of the codes it reads; empty: asked about every target
  std::function<std::unique_ptr<Method>(const Recording&, std::uint64_t seed)> make = {};

  /// Whether it can be asked about this target at all.
  bool asked_about(const Target& target) const;
};

/// mute, still, linear and oracle.
bool is_yardstick(const std::string& name);

/// Whether it detects in every frame and knows nothing of the frames before.
bool is_detection(const Methods& methods, const MethodSpec& spec);

/// Names of all methods, yardsticks and combinations too.
std::vector<std::string> method_names(const Methods& methods);

/// Says that no method is called so, and which one may be meant.
Error unknown_method(const Methods& methods, const std::string& name);

/// Every Method that is run comes from here. Throws Error for an unknown name (the nearest one is offered) or
/// option, and for a combination of what does not combine.
ChosenMethod choose(const Methods& methods, const MethodSpec& spec);

/// mute, still, linear and oracle, as far as they fit the protocol and are not among `chosen` already: every
/// comparison carries them.
std::vector<ChosenMethod> yardsticks(const Methods& methods, bool with_start,
                                     const std::vector<ChosenMethod>& chosen);

/// The entry of a detector; throws Error when there is none (said differently when it is a tracker).
const DetectorEntry& detector_entry(const Methods& methods, const std::string& name);

}  // namespace relock
