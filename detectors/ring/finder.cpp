#include "detectors/ring/finder.h"

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>

namespace relock::ring {
namespace {

/// What is looked for on one level of the pyramid. Radii are half a chord's outer length, px of the level.
struct LevelSearch {
  int least_rise;  // grey levels over two px
  double least_radius_px, most_radius_px;
  int direction_step;  // every direction, or every fourth: along x and along y
};

// Each level has the radii at which its rings are two to eight px wide; averaging lowers noise, so that weaker
// edges can be told from it.
constexpr std::array<LevelSearch, Pyramid::kLevels> kLevels = {{
    {16, 7.5, 19, 4},
    {11, 9, 34, 1},
    {9, 16, std::numeric_limits<double>::infinity(), 1},
}};

}  // namespace

CandidateFinder::CandidateFinder(const RingGeometry& geometry, const FinderOptions& options)
    : options_(options), chord_finder_(geometry, options.most_blur, options.least_likeness) {}

const std::vector<Candidate>& CandidateFinder::find(const Pyramid& pyramid) {
  chords_.clear();
  const double largest = options_.max_diameter_px > 0
                             ? options_.max_diameter_px / 2
                             : std::max(pyramid.full().cols, pyramid.full().rows) / 2.0;
  for (std::size_t level = 0; level < Pyramid::kLevels; ++level) {
    const cv::Mat& picture = pyramid.level[level];
    if (picture.empty()) continue;
    const LevelSearch& here = kLevels[level];
    const double scale = std::ldexp(1.0, static_cast<int>(level));
    if (here.direction_step == 1) cv::transpose(picture, transposed_[level]);
    for (std::size_t direction = 0; direction < kLineDirections.size();
         direction += static_cast<std::size_t>(here.direction_step)) {
      const ChordSearch search{static_cast<int>(direction), level, here.least_rise,
                               std::max(here.least_radius_px, options_.min_diameter_px / 2 / scale),
                               std::min(here.most_radius_px, largest / scale)};
      if (search.least_radius_px > search.most_radius_px) continue;
      scan_.read(picture, transposed_[level], kLineDirections[direction]);
      chord_finder_.find(scan_, search, chords_);
    }
  }
  return grouper_.group(chords_);
}

}  // namespace relock::ring
