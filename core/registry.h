#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/detector.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/options.h"
#include "core/tracker.h"

namespace relock {

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
};

/// A tracker that can be asked for by name.
struct TrackerEntry {
  std::string name;
  std::string sentence;
  std::vector<OptionInfo> options = {};
  bool deterministic = true;    ///< the same seed gives the same answers
  bool honours_expect = false;  ///< Tracker::expect changes what it does
  std::string needs = {};       ///< what it cannot work without and relock does not bring; empty: it is ready
  /// A new tracker for one start.
  std::function<std::unique_ptr<Tracker>(const Options&, std::uint64_t seed)> make;
};

/// Entries by name, in the order in which they were added. Explicit lists fill it (detectors/builtin.cpp,
/// trackers/builtin.cpp): self-registering globals in a static library are dropped by the linker.
template <class Entry>
class Registry {
 public:
  /// Throws Error when the name is taken.
  void add(Entry entry) {
    if (find(entry.name)) throw Error(fmt::format("two methods are called \"{}\"", entry.name));
    entries_.push_back(std::move(entry));
  }

  /// Null when there is none.
  const Entry* find(std::string_view name) const {
    const auto at =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
    return at == entries_.end() ? nullptr : &*at;
  }

  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Entry& entry : entries_) all.push_back(entry.name);
    return all;
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace relock
