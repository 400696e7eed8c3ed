#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/entry.h"
#include "core/error.h"
#include "core/nearest.h"

namespace relock {

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
