#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/printed_target.h"
#include "core/truth.h"

namespace relock::simulator {

/// What a picture's blur averages.
enum class BlurIn : std::uint8_t {
  coded,  ///< the picture's own grey values: what the paper does, and all who blur pictures they have
  light,  ///< linear light, as a sensor does; the dark parts of a marker then shrink
};

/// The experiment of section 3.1 of the paper: a marker seen straight on, blurred artificially. One picture for
/// each length, direction and repetition, in this order, the last running fastest.
struct CanvasPlan {
  int canvas_px = 480;     ///< side of the square picture
  double marker_px = 150;  ///< diameter or side of the outline in it
  std::vector<double> lengths_px = {0, 15, 30, 35, 40, 45, 50, 65, 80};  ///< of the blur
  std::vector<double> angles_deg = {0, 22, 45, 67, 90, 112, 135, 157};   ///< from +x towards +y
  int repetitions = 1;  ///< each with a place and noise of its own
  double noise = 2;     ///< standard deviation, grey levels
  double grey = 128;    ///< around the sheet
  BlurIn blur_in = BlurIn::coded;
};

/// Throws Error naming the part of the plan that is out of range, and when the blurred outline does not fit.
void check_canvas(const CanvasPlan& plan);

/// How many pictures there are.
std::size_t canvas_pictures(const CanvasPlan& plan);

struct CanvasPicture {
  cv::Mat pixels;     ///< CV_8UC1
  TargetTruth truth;  ///< exact: outline (Ellipse or Quad), centre, and the blur from -length/2 to +length/2
};

/// The picture of rank `rank`, of a plan that was checked. Every pixel is the mean of the sheet and what is
/// around it over the pixel's area, exactly, blurred by blur_kernel (core/blur.h); the centre is within half a
/// pixel of the middle, at random. The same arguments, the same bytes.
CanvasPicture canvas_picture(const CanvasPlan& plan, const PrintedTarget& target, std::size_t rank,
                             std::uint64_t seed);

/// Writes all pictures as a recording that open_sequence reads, at 30 Hz, named as the folder is. `folder` is
/// whole or not there at all. `plan_text`, if any, is kept in it as canvas.toml. Throws Error when it exists, on a plan or target that cannot be, and on a full disk.
void write_canvas(const std::filesystem::path& folder, const CanvasPlan& plan, const PrintedTarget& target,
                  std::uint64_t seed, const std::string& plan_text = {});

}  // namespace relock::simulator
