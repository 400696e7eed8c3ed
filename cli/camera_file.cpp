#include "cli/camera_file.h"

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <vector>

#include "cli/files.h"
#include "core/error.h"

namespace relock {
namespace {

/// A matrix of OpenCV's, or rows, cols and a list of ROS's.
std::vector<double> numbers(const cv::FileNode& node) {
  std::vector<double> all;
  const cv::FileNode data = node.isMap() ? node["data"] : node;
  if (!data.isSeq()) return all;
  for (const cv::FileNode& number : data) {
    if (!number.isReal() && !number.isInt()) return {};
    all.push_back(static_cast<double>(number));
  }
  return all;
}

pose::Camera camera_of(const cv::FileStorage& storage, const std::string& name) {
  const auto matrix = numbers(storage["camera_matrix"]);
  if (matrix.size() != 9)
    throw Error(fmt::format("{}: camera_matrix with its 9 numbers is missing; is it a calibration?", name));
  const auto distortion = numbers(storage["distortion_coefficients"]);
  if (distortion.size() > 5)
    throw Error(
        fmt::format("{}: distortion_coefficients has {} numbers; up to 5 (k1, k2, p1, p2, k3) are known",
                    name, distortion.size()));
  const cv::FileNode model = storage["distortion_model"];
  if (model.isString() && model.string() != "plumb_bob")
    throw Error(fmt::format("{}: distortion_model is {}; only plumb_bob is known", name, model.string()));
  pose::Camera camera;
  camera.fx = matrix[0], camera.fy = matrix[4], camera.cx = matrix[2], camera.cy = matrix[5];
  std::copy(distortion.begin(), distortion.end(), camera.distortion.begin());
  if (storage["image_width"].isInt() && storage["image_height"].isInt())
    camera.picture = {static_cast<int>(storage["image_width"]), static_cast<int>(storage["image_height"])};
  try {
    check(camera);
  } catch (const Error& fault) {
    throw Error(fmt::format("{}: {}", name, fault.what()));
  }
  return camera;
}

}  // namespace

pose::Camera read_camera(const std::filesystem::path& file) {
  std::string text = read_file(file);
  // OpenCV takes no YAML without a header, and ROS writes none.
  const bool marked = text.starts_with("%YAML") || text.starts_with("<?xml") || text.starts_with("{");
  if (!marked) text = "%YAML:1.0\n---\n" + text;
  cv::FileStorage storage;
  try {
    storage.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  } catch (const cv::Exception& fault) {
    throw Error(fmt::format("{} cannot be read as a calibration: {}", file.string(), fault.err));
  }
  if (!storage.isOpened()) throw Error(fmt::format("{} cannot be read as a calibration", file.string()));
  return camera_of(storage, file.string());
}

}  // namespace relock
