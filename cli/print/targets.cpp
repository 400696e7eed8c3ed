#include "cli/print/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "cli/print/design.h"
#include "core/display_coding.h"
#include "core/error.h"

namespace relock {
namespace {

constexpr int kSidePx = 1024;
constexpr int kPartsOfPixel = 16;  // in each direction, where an edge runs through it

std::uint8_t level(double light) {
  return static_cast<std::uint8_t>(std::lround(255 * coded_of_light(light)));
}

/// Mean light of a print about a middle, over one pixel after another.
class RoundPrint {
 public:
  explicit RoundPrint(const RingMarker& marker)
      : marker_(marker), pixel_(2 * marker.geometry.sheet_radius() / kSidePx) {
    for (const Annulus& ring : rings_of(marker)) edges_.insert(edges_.end(), {ring.inner, ring.outer});
    edges_.insert(edges_.end(), {marker.geometry.quiet_zone, marker.geometry.sheet_radius()});
  }

  /// Of the pixel that many pixels right of and below the middle (its centre).
  double light_at(double right, double down) const {
    const double rho = pixel_ * std::hypot(right, down);
    const bool edge = std::any_of(edges_.begin(), edges_.end(),
                                  [&](double radius) { return std::abs(radius - rho) < 0.75 * pixel_; });
    if (!edge) return reflectance(marker_, rho);
    double sum = 0;
    for (int y = 0; y < kPartsOfPixel; ++y)
      for (int x = 0; x < kPartsOfPixel; ++x)
        sum += reflectance(marker_, pixel_ * std::hypot(right + part(x), down + part(y)));
    return sum / (kPartsOfPixel * kPartsOfPixel);
  }

 private:
  static double part(int index) { return (index + 0.5) / kPartsOfPixel - 0.5; }

  RingMarker marker_;
  double pixel_;  // parts of R
  std::vector<double> edges_;
};

cv::Mat1b picture_of(const RingMarker& marker) {
  const RoundPrint print(marker);
  const double dark = reflected_by(marker.sheet).grey();
  cv::Mat1b picture(kSidePx, kSidePx);
  constexpr int kHalf = kSidePx / 2;
  for (int y = 0; y < kHalf; ++y)  // a quarter, and its three reflections
    for (int x = 0; x < kHalf; ++x)
      picture(kHalf + y, kHalf + x) = picture(kHalf + y, kHalf - 1 - x) = picture(kHalf - 1 - y, kHalf + x) =
          picture(kHalf - 1 - y, kHalf - 1 - x) = level(dark + (1 - dark) * print.light_at(x + 0.5, y + 0.5));
  return picture;
}

/// The edges of all cells lie between pixels, so that none has to be smoothed.
cv::Mat1b picture_of(const MarkerCells& cells) {
  const int cell = (kSidePx + cells.side / 2) / cells.side;
  cv::Mat1b picture(cells.side * cell, cells.side * cell);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      picture(y, x) = cells.grey[static_cast<std::size_t>(y / cell * cells.side + x / cell)];
  return picture;
}

}  // namespace

PrintedTarget print_target(std::string_view name, double size_m) {
  if (!(size_m > 0 && std::isfinite(size_m)))
    throw Error(fmt::format("{} cannot be {} m large; give it a size above 0", name, size_m));
  const Design design = design_of(name);
  return {.name = design.name,
          .code = design.code,
          .outline = design.round() ? PrintedOutline::circle : PrintedOutline::square,
          .size_m = size_m,
          .sheet_m = size_m * design.sheet(),
          .picture = std::visit([](const auto& form) { return cv::Mat(picture_of(form)); }, design.form)};
}

}  // namespace relock
