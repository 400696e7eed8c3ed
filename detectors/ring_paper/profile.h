#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "detectors/ring_paper.h"
#include "detectors/ring_paper/axis.h"

namespace relock::ring_paper {

/// Grey levels along a line, one each px.
struct Profile {
  Vec2 from;       ///< where the first level is
  Vec2 direction;  ///< of length 1, to the next one
  std::vector<float> levels;

  Vec2 at(double rank) const { return from + rank * direction; }
};

/// The mean of `lines` parallel lines, `spacing_px` apart, the middle one along `segment`: the patch, projected on
/// its direction. `level_at` says the grey level at a point.
Profile intensity_profile(const std::function<float(Vec2)>& level_at, const Segment& segment, int lines,
                          double spacing_px);

/// The grey level of the picture by linear interpolation; beyond its border that of the border.
float level_at(const cv::Mat1b& picture, Vec2 point);

/// A bright stretch of a profile, from the transition to white to the one to black; ranks, with fractions.
struct Bar {
  double from = 0, to = 0;
  double width() const { return to - from; }
  friend bool operator==(const Bar&, const Bar&) = default;
};

/// All bright stretches that begin and end within the profile.
///
/// Binarisation::local: bright and dark turning points alternate, each at least `prominence` of the profile's range
/// away from the next, and the transition is halfway between two of them: under blur neighbouring rings are not
/// equally bright, nor are the gaps between them equally dark. Binarisation::middle: where the profile crosses the
/// middle of its range.
std::vector<Bar> bright_bars(const std::vector<float>& levels, Binarisation binarisation, double prominence);

/// What the rings of one marker show along a line through its middle.
struct Marks {
  std::vector<Bar> bars;
  double from() const { return bars.front().from; }
  double to() const { return bars.back().to; }
  double middle() const { return (from() + to()) / 2; }
  double radius() const { return (to() - from()) / 2; }
  int rings() const { return static_cast<int>(bars.size()) / 2; }
};

/// All bars in a row that can be a marker of so many bits: two for each ring, of which there are at least two and
/// at most two more than bits, none wider or narrower than their mean width by more than `tolerance` of it. What
/// lies beyond a marker, the edge of its sheet for one, may show bars too, so they need not be all there are.
std::vector<Marks> allowable_marks(const std::vector<Bar>& bars, int bits, double tolerance);

/// `samples` levels at even distances from one outer transition to the other, the darkest 0 and the brightest 1.
std::vector<float> normalised(const std::vector<float>& levels, const Marks& marks, int samples);

}  // namespace relock::ring_paper
