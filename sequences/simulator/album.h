#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/truth.h"

namespace relock::simulator {

/// A picture and what is true of each target of the album.
struct AlbumPage {
  cv::Mat pixels;  ///< CV_8UC1
  std::vector<TargetTruth> truth;
};

/// Pictures that have nothing to do with each other, and what is to be seen in them.
struct Album {
  Size picture;
  std::vector<Target> targets = {};
  std::size_t pages = 0;
  std::function<AlbumPage(std::size_t rank)> page = {};
  std::string plan_name =
      {};  ///< a file beside the pictures that holds `plan_text`; without a text there is none
  std::string plan_text = {};
  std::string calibration_text = {};  ///< kept as camera.yaml; empty: none
};

/// Writes an album as a recording that open_sequence reads, at 30 Hz, named as the folder is; pictures are PNG.
/// `folder` is whole or not there at all. Throws Error when it exists, and on a full disk.
void write_album(const std::filesystem::path& folder, const Album& album);

}  // namespace relock::simulator
