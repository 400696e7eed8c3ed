#pragma once

#include <cairo.h>

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "cli/comparison.h"
#include "cli/video/shots.h"

namespace relock {

/// One method in a video: its picture with truth and answers drawn on it, what is said of it above, and its lanes below.
class Panel {
 public:
  /// `compared` outlives it. `scale`: of the recording's pictures.
  Panel(const ScoredComparison& compared, std::size_t run, std::vector<std::size_t> targets, double scale);

  Size size() const;
  /// At `corner`. `picture`: of the shot's frame, CV_8UC3; empty before the first.
  void draw(cairo_t* on, Vec2 corner, const cv::Mat& picture, const Shot& shot) const;
  /// What is said above the picture: "Hit, 1.2 px", "Miss, lost for 0.43 s"; of several targets "2 Hit, 1 Miss".
  std::string status(const Shot& shot) const;

 private:
  const Recording& recording() const { return compared_.stored.recording; }
  const StoredRun& run() const { return compared_.stored.runs[run_]; }
  const TargetTimeline& timeline(std::size_t target) const {
    return compared_.evaluations[run_].targets[target];
  }
  std::string status_of(std::size_t target, std::size_t frame) const;
  double lost_for_s(std::size_t target, std::size_t frame) const;
  Verdict worst(std::size_t frame) const;
  bool is_shown(const TargetId& id) const;
  void draw_heading(cairo_t* on, Vec2 corner, const Shot& shot) const;
  void draw_answers(cairo_t* on, std::size_t frame) const;
  void draw_truth(cairo_t* on, std::size_t frame) const;
  void draw_standstill(cairo_t* on, Vec2 corner, const Shot& shot) const;
  void draw_lanes(cairo_t* on, Vec2 corner, Time now) const;

  const ScoredComparison& compared_;
  std::size_t run_;
  std::vector<std::size_t> targets_;
  double scale_;
  double picture_width_, picture_height_, letters_;
};

}  // namespace relock
