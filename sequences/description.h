#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "core/truth.h"

namespace relock {

/// Rates that a camera may have, Hz.
constexpr double kLeastRate_hz = 1e-3, kMostRate_hz = 1e6;

/// What `recording.toml` beside a recording says of it. Everything in it is optional:
///
///     name = "flight 7"          # else the folder's name
///     rate_hz = 30.0             # else the nominal period is found from the capture times
///     sigma_px = 1.0             # accuracy of the labels, one standard deviation; else exact
///     [[target]]                 # else the targets are those that the labels name
///     id = "door"
///     code = "aruco6x6_250:23"   # what a reader of codes should read on it
///     size_m = 0.15              # side or diameter
///     sigma_px = 0.1             # for this target
struct Description {
  struct LabelledTarget {
    Target target;
    std::optional<double> sigma_px;
  };
  std::string name;
  std::optional<double> rate_hz;   ///< stated
  std::optional<Duration> period;  ///< stated: from rate_hz, or period_ns where whole nanoseconds matter
  std::optional<Size> picture;     ///< width, height: only where no pictures are at hand
  double sigma_px = 0;
  std::vector<LabelledTarget> targets;
};

/// Reads FOLDER/recording.toml; without one, only the name is filled in.
/// Throws Error with file, line and column for a key that is unknown or of another type.
Description read_description(const std::filesystem::path& folder);
/// Reads FILE for a recording that is called `name` if the file does not say; there need not be such a file.
Description read_description(const std::filesystem::path& file, const std::string& name);

/// A text as TOML writes it, quoted.
std::string toml_string(std::string_view text);

/// The folder's own name, however the path to it is written.
std::string folder_name(const std::filesystem::path& folder);

}  // namespace relock
