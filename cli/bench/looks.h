#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/detector.h"
#include "core/printed_target.h"
#include "core/truth.h"
#include "detectors/pose/camera.h"
#include "sequences/simulator/canvas.h"
#include "sequences/simulator/stills.h"

// Made pictures, and what a detector makes of them.

namespace relock::bench {

/// A picture with what is true of it.
struct MadePicture {
  cv::Mat pixels;                                 ///< CV_8UC1
  std::optional<std::size_t> shown = {};          ///< which of the kind's targets; nothing: none
  TargetTruth truth = {};                         ///< of the one shown
  std::optional<simulator::SheetPose> pose = {};  ///< of the one shown, where it hangs before a camera
};

/// Pictures of one kind, as many as are asked for; the same rank, the same picture.
struct PictureKind {
  std::string name;  ///< "clutter, D 150, blur 65"
  std::vector<PrintedTarget> targets;
  std::function<MadePicture(std::size_t rank)> make;
  std::optional<pose::Camera> camera = {};  ///< that took them, where one did
};

/// Which seeds pictures are made from. A detector is tuned on even ones and reported on odd ones.
enum class Seeds : std::uint8_t { odd, even };

/// Stills of these targets (none: without a target), in turn.
PictureKind stills(const std::string& name, const simulator::StillPlan& plan,
                   const std::vector<PrintedTarget>& targets, Seeds seeds);
/// The paper's canvas: a target of `marker_px`, straight on, blurred by `blur_px` in directions that go round.
PictureKind canvas(const std::string& name, double marker_px, double blur_px,
                   const std::vector<PrintedTarget>& targets, Seeds seeds);

/// What a detector made of one picture, judged by the evaluator.
struct Look {
  bool recognised = false;                    ///< found, and its code read rightly
  int wrong = 0;                              ///< sightings with another code, or of something else
  std::optional<double> centre_px = {};       ///< error of the centre, where recognised
  std::optional<double> direction_deg = {};   ///< error of the blur's direction, where it has one and says so
  std::optional<double> length_percent = {};  ///< and of its length
  std::optional<double> depth_percent = {};   ///< error of the likeliest pose's depth, where the pose is true
  std::optional<double> normal_deg = {};      ///< and of its normal
};

Look judged(const MadePicture& picture, const PictureKind& kind, const Sightings& sightings);

/// Makes `count` pictures of a kind and shows each to a detector, `jobs` at a time; the same for any number. Calls
/// `looked` after each, one at a time.
std::vector<Look> look_at(const PictureKind& kind, std::size_t count, int jobs,
                          const std::function<std::unique_ptr<Detector>()>& make_detector,
                          const std::function<void()>& looked);

}  // namespace relock::bench
