#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/image.h"
#include "core/time.h"

namespace relock::simulator {

/// Writes a video to look at: an MP4 with H.264 in it, in which every frame stands at its capture time, counted
/// from the first frame's, to the microsecond. Written under a temporary name, and not there at all unless
/// `finish` was called.
class PreviewWriter {
 public:
  /// Throws Error when `path` exists or cannot be written, or the installed libavcodec comes without libx264.
  PreviewWriter(const std::filesystem::path& path, Size picture, double rate_hz);
  ~PreviewWriter();

  /// `picture`: CV_8UC3 of the stated size. Throws Error on another, on a time that is not later than the last
  /// one by a microsecond or is by more than half an hour, and when the disk is full.
  void add(const cv::Mat& picture, Time captured);
  /// Throws Error when no frame was added or the file cannot be finished.
  void finish();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace relock::simulator
