#pragma once

#include <fmt/format.h>

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/nearest.h"

// Reading TOML files with faults told by file, line and column. Heavy: for .cpp files that read TOML only.

namespace relock {

/// One table of a TOML file, read key by key; a key that is not known is a mistake.
class TomlTable {
 public:
  /// Throws Error at a key that is not among `known` (the nearest one is offered).
  TomlTable(const toml::table& table, std::string file, std::vector<std::string> known)
      : table_(table), file_(std::move(file)), known_(std::move(known)) {
    for (const auto& entry : table_) {
      const toml::key& key = entry.first;
      const std::string name(key.str());
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        fail_at(key.source(), fmt::format("no key is called \"{}\"{}", name, did_you_mean(name, known_)));
    }
  }

  /// Nothing when the key is not there. Throws Error when its value is not `kind`: "a text".
  template <class T>
  std::optional<T> value(std::string_view key, std::string_view kind) const {
    const toml::node* found = table_.get(key);
    if (!found) return {};
    if (const auto value = found->value<T>()) return value;
    fail(*found, fmt::format("{} must be {}", key, kind));
  }

  std::optional<std::string> word(std::string_view key) const { return value<std::string>(key, "a text"); }

  std::optional<double> positive(std::string_view key, double least = 1e-9, double most = 1e9) const {
    const auto found = value<double>(key, "a number above 0");
    if (found && !(*found >= least && *found <= most))
      fail(*table_.get(key), fmt::format("{} must be from {} to {}", key, least, most));
    return found;
  }

  /// The nodes of a list; none when the key is not there. Throws Error when it is no list, or an empty one.
  std::vector<const toml::node*> list(std::string_view key) const {
    std::vector<const toml::node*> nodes;
    const toml::node* found = table_.get(key);
    if (!found) return nodes;
    const toml::array* array = found->as_array();
    if (!array) fail(*found, fmt::format("{} must be a list: [..., ...]", key));
    for (const toml::node& entry : *array) nodes.push_back(&entry);
    if (nodes.empty()) fail(*found, fmt::format("{} is an empty list", key));
    return nodes;
  }

  /// A list of numbers; `otherwise` when the key is not there.
  std::vector<double> numbers(std::string_view key, std::vector<double> otherwise) const {
    const auto nodes = list(key);
    if (nodes.empty()) return otherwise;
    std::vector<double> values;
    for (const toml::node* node : nodes) {
      const auto value = node->value<double>();
      if (!value) fail(*node, fmt::format("{} must be numbers", key));
      values.push_back(*value);
    }
    return values;
  }

  const toml::node* node(std::string_view key) const { return table_.get(key); }
  const std::string& file() const { return file_; }

  /// An Error at the place of `node`.
  [[noreturn]] void fail(const toml::node& node, std::string_view sentence) const {
    fail_at(node.source(), sentence);
  }

 private:
  [[noreturn]] void fail_at(const toml::source_region& place, std::string_view sentence) const {
    throw Error(fmt::format("{}:{}:{}: {}", file_, place.begin.line, place.begin.column, sentence));
  }

  const toml::table& table_;
  std::string file_;
  std::vector<std::string> known_;
};

/// Throws Error with file, line and column when the file is no TOML.
inline toml::table parse_toml(const std::filesystem::path& path) {
  try {
    return toml::parse_file(path.string());
  } catch (const toml::parse_error& fault) {
    const auto begin = fault.source().begin;
    if (begin.line == 0) throw Error(fmt::format("{} cannot be read", path.string()));
    throw Error(fmt::format("{}:{}:{}: {}", path.string(), begin.line, begin.column, fault.description()));
  }
}

}  // namespace relock
