#include "sequences/simulator/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/display_coding.h"
#include "core/error.h"
#include "core/random.h"
#include "sequences/simulator/album.h"
#include "sequences/simulator/sensor_noise.h"
#include "sequences/simulator/sheet.h"

namespace relock::simulator {
namespace {

constexpr std::uint64_t kPlaceKey = 1, kNoiseKey = 2;

/// Length and direction of the blur of a picture.
BlurEstimate blur_of(const CanvasPlan& plan, std::size_t rank) {
  const std::size_t cell = rank / static_cast<std::size_t>(plan.repetitions);
  const std::size_t angles = plan.angles_deg.size();
  return {plan.angles_deg[cell % angles] * std::numbers::pi / 180, plan.lengths_px[cell / angles]};
}

/// The integral of linear interpolation's weight of a sample at 0, from minus infinity to `x`.
double tent_up_to(double x) {
  if (x <= 0) return x <= -1 ? 0 : (1 + x) * (1 + x) / 2;
  return x >= 1 ? 1 : 1 - (1 - x) * (1 - x) / 2;
}

/// What part each of `samples` samples of a sheet has in each of `pixels` pixels, one row a pixel: the integral
/// over the pixel of linear interpolation between samples. `edge`: where the sheet begins, px; `per_pixel`:
/// samples. A row adds up to the part of the pixel that the sheet covers.
cv::Mat1d shares(int pixels, int samples, double edge, double per_pixel) {
  cv::Mat1d share(pixels, samples, 0.0);
  const double first = -0.5, last = samples - 0.5;  // the sheet's edges, in samples
  for (int p = 0; p < pixels; ++p) {
    const double from = std::clamp(first + (p - 0.5 - edge) * per_pixel, first, last);
    const double to = std::clamp(first + (p + 0.5 - edge) * per_pixel, first, last);
    if (!(to > from)) continue;
    // Between the outermost samples and the edges the outermost ones hold: as if there was one more of each.
    for (int s = cvFloor(from); s <= cvCeil(to); ++s)
      share(p, std::clamp(s, 0, samples - 1)) += (tent_up_to(to - s) - tent_up_to(from - s)) / per_pixel;
  }
  return share;
}

/// Replaces grey levels by light (0 to 1), or light by grey levels.
void to_light(cv::Mat1d& picture) {
  for (double& value : picture) value = light_of_coded(value / 255);
}
void to_coded(cv::Mat1d& picture) {
  for (double& value : picture) value = 255 * coded_of_light(value);
}

/// Most of a share matrix is 0, and a full product would take as long as all the rest.
cv::Mat1d weighted(const cv::Mat1d& share, const cv::Mat1d& rows) {
  cv::Mat1d sums(share.rows, rows.cols, 0.0);
  for (int p = 0; p < share.rows; ++p)
    for (int s = 0; s < share.cols; ++s)
      if (share(p, s) != 0) cv::scaleAdd(rows.row(s), share(p, s), sums.row(p), sums.row(p));
  return sums;
}

/// The sheet about `centre` on grey; in light if the blur is in light.
cv::Mat1d drawn(const CanvasPlan& plan, const PrintedTarget& target, Vec2 centre) {
  cv::Mat1d sheet;
  target.picture.convertTo(sheet, CV_64F);
  cv::Mat1d around(1, 1, plan.grey);
  if (plan.blur_in == BlurIn::light) to_light(sheet), to_light(around);
  const double side = plan.marker_px * target.sheet_m / target.size_m;
  const cv::Mat1d across = shares(plan.canvas_px, sheet.cols, centre.x - side / 2, sheet.cols / side);
  const cv::Mat1d down = shares(plan.canvas_px, sheet.rows, centre.y - side / 2, sheet.rows / side);
  cv::Mat1d rows, picture;
  cv::transpose(weighted(down, sheet), rows);
  cv::transpose(weighted(across, rows), picture);
  cv::Mat1d covered_x, covered_y;
  cv::reduce(across, covered_x, 1, cv::REDUCE_SUM);
  cv::reduce(down, covered_y, 1, cv::REDUCE_SUM);
  cv::Mat uncovered;
  cv::gemm(covered_y, covered_x, -around(0, 0), picture, 1, uncovered, cv::GEMM_2_T);
  uncovered += around(0, 0);
  return uncovered;
}

void add_noise(cv::Mat1d& picture, double deviation, const Random& random) {
  Noise noise(random);
  double* value = picture.ptr<double>();
  for (std::size_t i = 0; i < picture.total(); i += 4) {
    const auto normal = noise.next();
    for (std::size_t k = 0; k < std::min<std::size_t>(4, picture.total() - i); ++k)
      value[i + k] += deviation * static_cast<double>(normal[k]);
  }
}

Outline outline_of(const PrintedTarget& target, Vec2 centre, double size) {
  const double half = size / 2;
  if (target.outline == PrintedOutline::circle) return Ellipse{centre, half, half, 0};
  return Quad{{centre + Vec2{-half, -half}, centre + Vec2{half, -half}, centre + Vec2{half, half},
               centre + Vec2{-half, half}}};
}

TargetTruth truth_of(const CanvasPlan& plan, const PrintedTarget& target, Vec2 centre,
                     const BlurEstimate& blur) {
  TargetTruth truth;
  truth.label = Label::visible;
  truth.outline = outline_of(target, centre, plan.marker_px);
  truth.centre_projected = centre;
  truth.blur = blur.length_px * Vec2{std::cos(blur.direction_rad), std::sin(blur.direction_rad)};
  truth.tilt_deg = 0;
  return truth;
}

[[noreturn]] void refuse(std::string_view what) { throw Error(fmt::format("a canvas {}", what)); }

}  // namespace

void check_canvas(const CanvasPlan& plan) {
  if (plan.canvas_px < 16 || plan.canvas_px > 8192) refuse(fmt::format("of {} px is none", plan.canvas_px));
  if (!(plan.marker_px >= 1)) refuse(fmt::format("cannot show a marker of {} px", plan.marker_px));
  if (plan.lengths_px.empty() || plan.angles_deg.empty() || plan.repetitions < 1)
    refuse("needs a length, an angle and a repetition at least");
  for (const double angle : plan.angles_deg)
    if (!std::isfinite(angle)) refuse(fmt::format("cannot blur at an angle of {} degrees", angle));
  for (const double length : plan.lengths_px)
    if (!(length >= 0 && plan.marker_px + length + 2 <= plan.canvas_px))
      refuse(fmt::format("of {} px has no room for a marker of {} px blurred by {} px", plan.canvas_px,
                         plan.marker_px, length));
  if (!(plan.noise >= 0 && plan.noise <= 255))
    refuse(fmt::format("cannot have noise of {} levels", plan.noise));
  if (!(plan.grey >= 0 && plan.grey <= 255)) refuse(fmt::format("cannot be of grey {}", plan.grey));
}

std::size_t canvas_pictures(const CanvasPlan& plan) {
  return plan.lengths_px.size() * plan.angles_deg.size() * static_cast<std::size_t>(plan.repetitions);
}

CanvasPicture canvas_picture(const CanvasPlan& plan, const PrintedTarget& target, std::size_t rank,
                             std::uint64_t seed) {
  const Random random = Random(seed).fork(rank);
  Random place = random.fork(kPlaceKey);
  const double middle = (plan.canvas_px - 1) / 2.0, x = place.uniform(), y = place.uniform();
  const Vec2 centre{middle + x - 0.5, middle + y - 0.5};
  const BlurEstimate blur = blur_of(plan, rank);

  cv::Mat1d picture = drawn(plan, target, centre);
  if (blur.length_px > 0)
    cv::filter2D(picture, picture, CV_64F, blur_kernel(blur), {-1, -1}, 0, cv::BORDER_REPLICATE);
  if (plan.blur_in == BlurIn::light) to_coded(picture);
  if (plan.noise > 0) add_noise(picture, plan.noise, random.fork(kNoiseKey));
  CanvasPicture made{{}, truth_of(plan, target, centre, blur)};
  picture.convertTo(made.pixels, CV_8U);
  return made;
}

void write_canvas(const std::filesystem::path& folder, const CanvasPlan& plan, const PrintedTarget& target,
                  std::uint64_t seed, const std::string& plan_text) {
  check_canvas(plan);
  check_sheet(target);
  write_album(folder, {.picture = {plan.canvas_px, plan.canvas_px},
                       .targets = {{target.name, target.code, target.size_m}},
                       .pages = canvas_pictures(plan),
                       .page = [&](std::size_t rank) -> AlbumPage {
                         const CanvasPicture made = canvas_picture(plan, target, rank, seed);
                         return {made.pixels, {made.truth}};
                       },
                       .plan_name = "canvas.toml",
                       .plan_text = plan_text});
}

}  // namespace relock::simulator
