#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/printed_target.h"
#include "core/truth.h"
#include "sequences/simulator/canvas.h"
#include "sequences/simulator/range.h"
#include "sequences/simulator/sheet_pose.h"

namespace relock::simulator {

/// What is behind a target.
enum class Backdrop : std::uint8_t {
  plain,    ///< one grey level
  clutter,  ///< a jumble of what deceives detectors (jumble.h), another in each still
};

/// Stills: one target at stated size, tilt and blur before a stated backdrop, or no target; each still another
/// place, pose and backdrop. What a range states is drawn evenly from it.
struct StillPlan {
  Size picture{640, 480};
  double focal_widths = 0.9;  ///< focal length, in widths of the picture; no distortion
  double shown = 1;           ///< share of the stills that show a target; the others do without
  Range size_px{60, 150};     ///< a ring's D of metrics.md; for a square, of the circle in it (Hang::size_px)
  Range tilt_deg{0, 45};      ///< between the target's normal and the line of sight, towards any side
  Range turn_deg{0, 360};     ///< of the sheet in its own plane
  std::vector<double> blurs_px{0};  ///< lengths, in turn; towards any side, the same for all of a picture
  Range noise{2, 5};                ///< standard deviation, grey levels
  Range black{20, 50};              ///< grey level of the sheet's black
  Range white{150, 235};            ///< and of its white
  Backdrop backdrop = Backdrop::clutter;
  double grey = 128;  ///< of a plain backdrop
  BlurIn blur_in = BlurIn::coded;

  Camera camera() const { return {.picture = picture, .focal_px = focal_widths * picture.width}; }
};

/// Throws Error naming the part of the plan that is out of range.
void check_stills(const StillPlan& plan);

struct Still {
  cv::Mat pixels;  ///< CV_8UC1
  /// Of each target asked for, in this order; all but the one shown are absent. Outline and both centres are exact.
  std::vector<TargetTruth> targets;
  std::optional<std::size_t> shown;  ///< which target is in it, if one is
  SheetPose pose;                    ///< of the one shown, at the middle of the exposure
  double noise = 0;                  ///< standard deviation, grey levels
  Vec2 blur;                         ///< of the whole picture, from start to end of the exposure, px
};

/// The still of rank `rank`, of a plan that was checked. Blur lengths run fastest over the ranks, then targets;
/// without targets, nothing but backdrop. The outline at mid-exposure is in the picture with kStillBorder_px
/// around it; its smear may be cut.
///
/// Everything is drawn at twice the resolution, the sheet there as the mean of at least 2x2 places a pixel
/// (sheet.h), smeared there along the blur's line (smear.h), averaged over the picture's pixels, and only then
/// coded, if light was blurred, and made noisy. The same arguments, the same bytes; place, pose and backdrop do
/// not depend on blurs and noise.
///
/// Throws Error on a sheet that is none, and when the target finds no room in the picture or before the camera.
Still still(const StillPlan& plan, std::span<const PrintedTarget> targets, std::size_t rank,
            std::uint64_t seed);

constexpr double kStillBorder_px = 3;

/// Writes the stills of rank 0 to `count` - 1 as a recording, as write_album does. `plan_text`, if any, is kept in it
/// as stills.toml. Throws Error also on two targets of one name.
void write_stills(const std::filesystem::path& folder, const StillPlan& plan,
                  std::span<const PrintedTarget> targets, std::size_t count, std::uint64_t seed,
                  const std::string& plan_text = {});

}  // namespace relock::simulator
