// The pictures of a recording's folder, in order, and the one way its programs fail.
#pragma once

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace recordings {

/// The JPEG files of `folder`, sorted by name: the place in this list is the frame index.
/// Throws std::runtime_error if there are none.
inline std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".jpg") files.push_back(entry.path());
    }
  }
  if (files.empty()) throw std::runtime_error("no .jpg pictures in " + folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

/// A colour picture, 8 bit BGR. Throws std::runtime_error if the file is not one.
inline cv::Mat3b read_frame(const std::filesystem::path& file) {
  const cv::Mat3b picture = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (picture.empty()) throw std::runtime_error(file.string() + " is not a picture");
  return picture;
}

}  // namespace recordings
