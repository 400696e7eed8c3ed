#pragma once

#include <filesystem>
#include <vector>

#include "cli/comparison.h"
#include "cli/video/panel.h"
#include "core/frame_source.h"

namespace relock {

/// What a video shows of a comparison.
struct FilmPlan {
  std::vector<std::size_t> runs, targets;  ///< by their places; one panel for each run
  Time from, to;                           ///< which part
};
constexpr std::size_t kMostPanels = 16;

/// All panels of a moment on one sheet, side by side and below one another, with what they are about at its foot.
class Film {
 public:
  /// `compared` outlives it.
  Film(const ScoredComparison& compared, const FilmPlan& plan);

  const std::vector<Shot>& shots() const { return shots_; }
  Size size() const;
  /// The sheet of a shot, CV_8UC3. `picture`: of the shot's frame, CV_8UC3; empty before the first.
  cv::Mat sheet(const cv::Mat& picture, const Shot& shot) const;

 private:
  void draw_foot(cairo_t* on, const Shot& shot) const;

  const ScoredComparison& compared_;
  std::size_t columns_;
  std::vector<Panel> panels_;
  std::vector<Shot> shots_;
};

/// Writes the film into an MP4 (sequences/simulator/preview.h), its pictures from `frames`: a pass over the recording
/// from the first frame. Returns false when it was interrupted: then there is no file. Throws Error when the file is
/// there already or cannot be written, and when a picture cannot be read.
bool write_film(const Film& film, FrameSource& frames, Duration period, const std::filesystem::path& file);

}  // namespace relock
