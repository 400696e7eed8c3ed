#include "sequences/description.h"

#include <fmt/format.h>

#include <toml++/toml.h>

#include <algorithm>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

/// One table of the file, read key by key; what is left over is a mistake.
class Table {
 public:
  Table(const toml::table& table, std::string file, std::vector<std::string> known)
      : table_(table), file_(std::move(file)), known_(std::move(known)) {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        fail(node, fmt::format("no key is called \"{}\"{}", name, did_you_mean(name, known_)));
    }
  }

  template <class T>
  std::optional<T> value(std::string_view key, std::string_view kind) const {
    const toml::node* node = table_.get(key);
    if (!node) return {};
    if (const auto found = node->value<T>()) return found;
    fail(*node, fmt::format("{} must be {}", key, kind));
  }

  std::optional<std::string> word(std::string_view key) const { return value<std::string>(key, "a text"); }

  std::optional<double> positive(std::string_view key, double least = 1e-9, double most = 1e9) const {
    const auto found = value<double>(key, "a number above 0");
    if (found && !(*found >= least && *found <= most))
      fail(*table_.get(key), fmt::format("{} must be from {} to {}", key, least, most));
    return found;
  }

  const toml::node* node(std::string_view key) const { return table_.get(key); }

  [[noreturn]] void fail(const toml::node& node, std::string_view sentence) const {
    const auto begin = node.source().begin;
    throw Error(fmt::format("{}:{}:{}: {}", file_, begin.line, begin.column, sentence));
  }

 private:
  const toml::table& table_;
  std::string file_;
  std::vector<std::string> known_;
};

Description::LabelledTarget read_target(const toml::table& table, const std::string& file) {
  const Table entry(table, file, {"id", "code", "size_m", "sigma_px"});
  Description::LabelledTarget read;
  const auto id = entry.word("id");
  if (!id) entry.fail(table, "this target has no id");
  read.target.id = *id;
  if (read.target.id.find_first_of("\r\n") != std::string::npos)
    entry.fail(table, "a target's id is one line");
  try {
    if (const auto code = entry.word("code")) read.target.code = parse_code(*code);
  } catch (const Error& fault) {
    entry.fail(*entry.node("code"), fault.what());
  }
  read.target.size_m = entry.positive("size_m");
  read.sigma_px = entry.positive("sigma_px");
  return read;
}

void read_targets(const Table& root, const std::string& file, Description& description) {
  const toml::node* node = root.node("target");
  if (!node) return;
  const toml::array* tables = node->as_array();
  if (!tables) root.fail(*node, "targets are written [[target]]");
  for (const toml::node& entry : *tables) {
    const toml::table* table = entry.as_table();
    if (!table) root.fail(entry, "targets are written [[target]]");
    description.targets.push_back(read_target(*table, file));
    const auto& id = description.targets.back().target.id;
    const auto same = [&](const Description::LabelledTarget& other) { return other.target.id == id; };
    if (std::count_if(description.targets.begin(), description.targets.end(), same) > 1)
      root.fail(entry, fmt::format("two targets are called \"{}\"", id));
  }
}

}  // namespace

std::string folder_name(const std::filesystem::path& folder) {
  const auto canonical = std::filesystem::weakly_canonical(folder);
  return (canonical.has_filename() ? canonical : canonical.parent_path()).filename().string();
}

Description read_description(const std::filesystem::path& folder) {
  return read_description(folder / "recording.toml", folder_name(folder));
}

Description read_description(const std::filesystem::path& path, const std::string& called) {
  Description description;
  description.name = called;
  if (!std::filesystem::exists(path)) return description;

  const std::string file = path.string();
  toml::table parsed;
  try {
    parsed = toml::parse_file(file);
  } catch (const toml::parse_error& fault) {
    const auto begin = fault.source().begin;
    throw Error(fmt::format("{}:{}:{}: {}", file, begin.line, begin.column, fault.description()));
  }
  const Table root(parsed, file, {"name", "rate_hz", "period_ns", "width", "height", "sigma_px", "target"});
  if (const auto name = root.word("name")) description.name = *name;
  description.rate_hz = root.positive("rate_hz", kLeastRate_hz, kMostRate_hz);
  if (description.rate_hz) description.period = period_of(*description.rate_hz);
  if (const auto period = root.positive("period_ns", 1e9 / kMostRate_hz, 1e9 / kLeastRate_hz))
    description.period = Duration(std::llround(*period));
  const auto width = root.positive("width", 1, 1e5), height = root.positive("height", 1, 1e5);
  if (width && height) description.picture = Size{static_cast<int>(*width), static_cast<int>(*height)};
  description.sigma_px = root.positive("sigma_px").value_or(0);
  read_targets(root, file, description);
  return description;
}

}  // namespace relock
