#pragma once

#include <filesystem>
#include <fstream>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/recording.h"
#include "sequences/simulator/draft.h"
#include "sequences/simulator/flight_truth.h"

namespace relock::simulator {

/// What is told of one frame beside its picture.
struct FlownFrame {
  Time captured;
  double exposure_s = 0, gain = 1;
  double motion_px = 0;  ///< of what moves farthest
  int steps = 1;         ///< sub-exposures
  std::vector<FlightTruth> truth;
};

/// A flight as it is written: a recording in a draft beside the place where it will be.
class FlightWriter {
 public:
  /// Throws Error when `out` is there already or cannot be written.
  FlightWriter(const std::filesystem::path& out, std::vector<Target> targets, std::string picture_suffix);

  /// A picture's bytes as a file; may be called from several threads.
  void write_picture(FrameIndex frame, const std::vector<unsigned char>& bytes) const;
  /// The next frame's rows in the tables.
  void add(const FlownFrame& frame);
  /// The rest, and the draft becomes the recording. `recording`: name, picture, period, targets.
  void finish(const Recording& recording, const std::string& plan, const std::string& calibration);

 private:
  std::string name_of(FrameIndex frame) const;
  void check_tables() const;

  Draft draft_;
  std::vector<Target> targets_;
  std::string suffix_;
  FrameIndex frames_ = 0;
  std::ofstream times_, labels_, truth_;
};

}  // namespace relock::simulator
