#include "sequences/description.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/toml_table.h"

namespace relock {
namespace {

Description::LabelledTarget read_target(const toml::table& table, const std::string& file) {
  const TomlTable entry(table, file, {"id", "code", "size_m", "sigma_px"});
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

void read_targets(const TomlTable& root, const std::string& file, Description& description) {
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

std::string toml_string(std::string_view text) {
  std::string toml = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      toml += '\\';
      toml += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      toml += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      toml += c;
    }
  }
  return toml + "\"";
}

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
  const toml::table parsed = parse_toml(path);
  const TomlTable root(parsed, file,
                       {"name", "rate_hz", "period_ns", "width", "height", "sigma_px", "target"});
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
