#pragma once

#include <filesystem>

#include "detectors/pose/camera.h"

namespace relock {

/// A calibration: YAML (or XML, JSON) as OpenCV's calibration programs write it (camera_matrix, distortion_coefficients;
/// image_width and image_height if stated), or YAML as ROS's camera_info has it (the same names, data in lists). Throws
/// Error naming the file and what is missing or wrong in it.
pose::Camera read_camera(const std::filesystem::path& file);

}  // namespace relock
