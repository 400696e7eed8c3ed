#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "sequences/simulator/flight_plan.h"

namespace relock::simulator {

struct FlightOptions {
  int jobs = 1;  ///< frames made at a time; the bytes are the same for any number
  std::optional<std::filesystem::path> preview = {};  ///< a video of the flight, .mp4
  std::function<void(std::int64_t frames)> progress =
      {};  ///< is called as frames are done, from any thread, one at a time
};

struct FlightSummary {
  std::int64_t frames = 0;      ///< recorded
  std::int64_t lost = 0;        ///< of the gap pattern: not in the recording
  std::int64_t capped = 0;      ///< frames on which the sub-exposures did not do
  double coarsest_step_px = 0;  ///< of them
  double mean_motion_px = 0;    ///< of what moves farthest in each frame, over the exposure
};

/// How many frames a plan records; lost ones are not counted.
std::int64_t frames_of(const FlightPlan& plan);

/// Flies: writes the recording `out`, which must not exist, whole or not at all (a draft beside it is renamed in the end):
///
///   images/000000.jpg (or .png), timestamps.csv, labels.csv, recording.toml   as any recording (sequences/image_folder.h)
///   truth.csv                      what labels.csv has no columns for, frame by frame and target by target
///   flight.toml                    the plan, every quantity stated
///   camera.yaml                    the camera as a calibration file of OpenCV's
///
/// Memory does not depend on the flight's length, but for 16 bytes a frame. Throws Error on a plan that cannot be flown, a
/// folder that cannot be written, a full disk.
FlightSummary fly(const FlightPlan& plan, const TargetResolver& target_of, const std::filesystem::path& out,
                  const FlightOptions& options = {});

}  // namespace relock::simulator
