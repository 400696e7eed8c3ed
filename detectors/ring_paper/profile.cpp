#include "detectors/ring_paper/profile.h"

#include <algorithm>
#include <cmath>

namespace relock::ring_paper {
namespace {

/// Ranks where the profile turns, darkest and brightest by turns, each `swing` or more from the next.
std::vector<std::size_t> turning_points(const std::vector<float>& levels, float swing) {
  std::vector<std::size_t> turns;
  std::size_t low = 0, high = 0;
  bool rising = false, falling = false;  // neither before the first swing
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (levels[i] < levels[low]) low = i;
    if (levels[i] > levels[high]) high = i;
    if (!falling && levels[high] - levels[i] >= swing) {
      turns.push_back(high), low = i, falling = true, rising = false;
    } else if (!rising && levels[i] - levels[low] >= swing) {
      turns.push_back(low), high = i, rising = true, falling = false;
    }
    if (rising) low = i;
    if (falling) high = i;
  }
  if (rising) turns.push_back(high);
  if (falling) turns.push_back(low);
  return turns;
}

/// Where the profile first crosses `level` between the ranks `from` and `to`, which are on either side of it.
double crossing(const std::vector<float>& levels, std::size_t from, std::size_t to, float level) {
  const bool rising = levels[to] > levels[from];
  std::size_t i = from;
  while (i + 1 < to && (levels[i + 1] > level) != rising) ++i;
  const double step = levels[i + 1] - levels[i];
  return static_cast<double>(i) + (step == 0 ? 0.5 : (level - levels[i]) / step);
}

std::vector<Bar> bars_between_turns(const std::vector<float>& levels, float swing) {
  const std::vector<std::size_t> turns = turning_points(levels, swing);
  const auto halfway = [&](std::size_t i) {
    return crossing(levels, turns[i], turns[i + 1], (levels[turns[i]] + levels[turns[i + 1]]) / 2);
  };
  std::vector<Bar> bars;
  for (std::size_t i = 1; i + 1 < turns.size(); ++i)
    if (levels[turns[i]] > levels[turns[i - 1]]) bars.push_back({halfway(i - 1), halfway(i)});
  return bars;
}

std::vector<Bar> bars_above(const std::vector<float>& levels, float level) {
  std::vector<Bar> bars;
  double from = -1;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const bool bright = levels[i] > level;
    if (bright == (levels[i - 1] > level)) continue;
    const double at = crossing(levels, i - 1, i, level);
    if (bright) from = at;
    if (!bright && from >= 0) bars.push_back({from, at});
  }
  return bars;
}

/// The largest deviation of a width from the mean width, parts of it.
double unevenness(const Bar* first, const Bar* last) {
  double mean = 0, most = 0;
  for (const Bar* bar = first; bar != last; ++bar) mean += bar->width() / static_cast<double>(last - first);
  for (const Bar* bar = first; bar != last; ++bar)
    most = std::max(most, std::abs(bar->width() - mean) / mean);
  return most;
}

}  // namespace

float level_at(const cv::Mat1b& picture, Vec2 point) {
  const double x = std::clamp(point.x, 0.0, picture.cols - 1.0),
               y = std::clamp(point.y, 0.0, picture.rows - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, picture.cols - 1), bottom = std::min(top + 1, picture.rows - 1);
  const double fx = x - left, fy = y - top;
  return static_cast<float>((1 - fy) * ((1 - fx) * picture(top, left) + fx * picture(top, right)) +
                            fy * ((1 - fx) * picture(bottom, left) + fx * picture(bottom, right)));
}

Profile intensity_profile(const std::function<float(Vec2)>& level_at, const Segment& segment, int lines,
                          double spacing_px) {
  const Vec2 way = segment.to - segment.from;
  const double length = norm(way);
  if (!(length > 0)) return {};
  Profile profile{segment.from, (1 / length) * way, {}};
  const Vec2 across{-profile.direction.y, profile.direction.x};
  for (int i = 0; i <= length; ++i) {
    float sum = 0;
    for (int line = 0; line < lines; ++line)
      sum += level_at(profile.at(i) + (line - (lines - 1) / 2.0) * spacing_px * across);
    profile.levels.push_back(sum / static_cast<float>(lines));
  }
  return profile;
}

std::vector<Bar> bright_bars(const std::vector<float>& levels, Binarisation binarisation, double prominence) {
  if (levels.empty()) return {};
  const auto [darkest, brightest] = std::minmax_element(levels.begin(), levels.end());
  if (*brightest == *darkest) return {};
  if (binarisation == Binarisation::middle) return bars_above(levels, (*brightest + *darkest) / 2);
  return bars_between_turns(levels, static_cast<float>(prominence) * (*brightest - *darkest));
}

std::vector<Marks> allowable_marks(const std::vector<Bar>& bars, int bits, double tolerance) {
  std::vector<Marks> all;
  for (int rings = bits + 2; rings >= 2; --rings) {
    const auto count = 2 * static_cast<std::size_t>(rings);
    for (std::size_t first = 0; first + count <= bars.size(); ++first) {
      const Bar* from = bars.data() + first;
      if (unevenness(from, from + count) <= tolerance) all.push_back({{from, from + count}});
    }
  }
  return all;
}

std::vector<float> normalised(const std::vector<float>& levels, const Marks& marks, int samples) {
  std::vector<float> sampled;
  for (int i = 0; i < samples; ++i) {
    const double rank = marks.from() + (marks.to() - marks.from()) * i / (samples - 1);
    const auto before = std::min(static_cast<std::size_t>(rank), levels.size() - 2);
    const auto part = static_cast<float>(rank - static_cast<double>(before));
    sampled.push_back((1 - part) * levels[before] + part * levels[before + 1]);
  }
  const auto [darkest, brightest] = std::minmax_element(sampled.begin(), sampled.end());
  const float low = *darkest, range = std::max(*brightest - low, 1e-6F);
  for (float& level : sampled) level = (level - low) / range;
  return sampled;
}

}  // namespace relock::ring_paper
