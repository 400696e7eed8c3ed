#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/detector.h"
#include "core/options.h"
#include "core/tracker.h"

namespace relock {

/// The shared library that a method comes from, when it was not built in.
struct PluginFile {
  std::string name;         ///< without folders: "libmine.so"
  std::string fingerprint;  ///< of its bytes
};

/// A detector that can be asked for by name.
struct DetectorEntry {
  std::string name;
  std::string sentence;  ///< what it is, for `relock list`
  std::vector<OptionInfo> options = {};
  /// Families of the codes it reads with these options; empty: it reads no codes. A target whose code is of
  /// another family is not put to it.
  std::function<std::vector<std::string>(const Options&)> reads = [](const Options&) {
    return std::vector<std::string>{};
  };
  /// A new detector for one run. `seed` is for those that draw at random.
  std::function<std::unique_ptr<Detector>(const Options&, std::uint64_t seed)> make;
  std::optional<PluginFile> plugin = {};  ///< where it comes from; empty: built in
};

/// A promise of core/tracker.h that a library does not keep, named as `relock check` names it.
struct KnownFault {
  std::string check;
  std::string why;
};

/// A tracker that can be asked for by name.
struct TrackerEntry {
  std::string name;
  std::string sentence;
  std::vector<OptionInfo> options = {};
  bool deterministic = true;    ///< the same seed gives the same answers
  bool honours_expect = false;  ///< Tracker::expect changes what it does
  std::vector<KnownFault> known_faults = {};
  std::string needs = {};  ///< what it cannot work without and relock does not bring; empty: it is ready
  /// A new tracker for one start.
  std::function<std::unique_ptr<Tracker>(const Options&, std::uint64_t seed)> make;
  std::optional<PluginFile> plugin = {};  ///< where it comes from; empty: built in
};

}  // namespace relock
