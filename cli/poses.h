#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/json_text.h"
#include "core/geometry.h"
#include "detectors/pose/pose.h"

// `relock detect --pose`: where what was sighted is.

namespace relock {

/// Several markers on a flat plate, as a file has it:
///
///     [[marker]]
///     code = "ring2:00"
///     x_m = -0.2        # of its middle; x right and y down as the plate is seen from its front
///     y_m = -0.2
///
/// Throws Error with file, line and column.
std::vector<pose::Placed> read_layout(const std::filesystem::path& file);

/// What poses are made from.
struct PoseQuestion {
  pose::Camera camera;
  std::optional<double> size_m = {};      ///< of every marker by itself; else only the plate's pose is told
  std::vector<pose::Placed> layout = {};  ///< of a plate; empty: none
  pose::Accuracy accuracy = {};
};
/// Throws Error when neither size nor layout is given, and when the camera is of pictures of another size.
void check_question(const PoseQuestion& question, Size picture);

/// What was found, in words and as JSON; likeliest first, poses of less than 1 % left out.
std::string text_of(const std::vector<pose::Pose>& poses);
Json json_of(const std::vector<pose::Pose>& poses);

}  // namespace relock
