#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sequences/simulator/stills.h"

namespace relock::simulator {

/// Stills as a file states them.
struct StillsFile {
  StillPlan plan;
  /// As `relock marker` takes them.
  std::vector<std::string> targets = {"ring:00", "ring:01", "ring:10", "ring:11"};
  std::uint64_t seed = 1;
  int stills = 60;  ///< how many
};

/// Whether a plan file is one of stills: it says preset = "stills".
bool is_stills_file(const std::filesystem::path& file);
/// TOML: preset = "stills", targets, seed, stills, width, height and the quantities of StillPlan by their names; a
/// range is [low, high] or one number; backdrop is "plain" or "clutter", blur_in "coded" or "light". Throws Error with
/// file, line and column.
StillsFile read_stills_file(const std::filesystem::path& file);
/// The file that `read_stills_file` makes the same of.
std::string stills_file_text(const StillsFile& stills);

}  // namespace relock::simulator
