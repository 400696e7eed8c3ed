#include "detectors/ring/chords.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "detectors/ring/pyramid.h"
#include "detectors/ring/vector_clones.h"

namespace relock::ring {
namespace {

constexpr float kWidthRatio = 1.7F, kStrengthRatio = 3;  // between the two sides of one ring
constexpr float kLeastContrast = 20;                     // grey levels within a chord
constexpr float kGlanceAsymmetry = 0.3F;                 // of the contrast
constexpr float kAsymmetry = 0.22F;                      // energy of the odd part over that of the even
constexpr float kBarOverQuiet = 0.3F, kQuietOverDarkest = 0.4F;  // of the contrast
constexpr float kLeastVariance = 60;                             // grey levels squared, of a fold

constexpr float kHopelessAsymmetry = 0.45F;  // no foreshortening makes it little
constexpr float kNoMoreAsymmetry = 0.05F;    // no foreshortening could make it much less
constexpr float kInside = 1.06F;             // must be on the line; beyond its ends, its last values go on
constexpr float kQuietWidth = 0.13F;         // where the first look takes it to be dark
constexpr float kLeastForeshortening = 0.03F, kMostForeshortening = 0.25F;
constexpr float kEnd = static_cast<float>(kReach);
constexpr std::size_t kGlances = 8;

/// Up to which there is a next value to interpolate with.
float last_place(const Line& line) { return static_cast<float>(line.steps - 1) - 0.001F; }

float value_at(const Line& line, float step) {
  const int left = static_cast<int>(step);
  const float a = line.values[left], b = line.values[left + 1];
  return a + (step - static_cast<float>(left)) * (b - a);
}

/// Values at middle + half u / (1 + v u), for -u on the left and u on the right.
RELOCK_VECTOR_CLONES void read_both_sides(const std::uint8_t* __restrict values, float last, float middle,
                                          float half, float v, const float* __restrict u, std::size_t count,
                                          float* __restrict left, float* __restrict right) {
  std::array<float, 2 * kFoldSamples> part;
  std::array<std::int32_t, 2 * kFoldSamples> place;
  for (std::size_t i = 0; i < count; ++i) {
    const float to_left = std::max(middle - half * u[i] / (1 - v * u[i]), 0.0F);
    const float to_right = std::min(middle + half * u[i] / (1 + v * u[i]), last);
    place[i] = static_cast<std::int32_t>(to_left);
    part[i] = to_left - static_cast<float>(place[i]);
    place[kFoldSamples + i] = static_cast<std::int32_t>(to_right);
    part[kFoldSamples + i] = to_right - static_cast<float>(place[kFoldSamples + i]);
  }
  std::array<std::int32_t, 2 * kFoldSamples> near, far;
  for (std::size_t i = 0; i < count; ++i) {
    near[i] = values[place[i]];
    far[i] = values[place[i] + 1];
    near[kFoldSamples + i] = values[place[kFoldSamples + i]];
    far[kFoldSamples + i] = values[place[kFoldSamples + i] + 1];
  }
  for (std::size_t i = 0; i < count; ++i) {
    left[i] = static_cast<float>(near[i]) + part[i] * static_cast<float>(far[i] - near[i]);
    const std::size_t j = kFoldSamples + i;
    right[i] = static_cast<float>(near[j]) + part[j] * static_cast<float>(far[j] - near[j]);
  }
}

template <std::size_t n>
constexpr std::array<float, n> evenly_up_to(float end) {
  std::array<float, n> all{};
  for (std::size_t i = 0; i < n; ++i) all[i] = (static_cast<float>(i) + 0.5F) * end / static_cast<float>(n);
  return all;
}
constexpr auto kGlanceAt = evenly_up_to<kGlances>(kEnd);
constexpr auto kFoldAt = evenly_up_to<kFoldSamples>(kEnd);

}  // namespace

ChordFinder::ChordFinder(const RingGeometry& geometry, double most_blur, double least_likeness)
    : templates_(geometry, most_blur), least_likeness_(least_likeness) {
  const Annulus& outermost = geometry.slots.back();
  narrowest_ = static_cast<float>(0.5 * outermost.width());
  // Blur across a line joins a ring with its neighbours.
  widest_ = static_cast<float>(std::max(3.2 * outermost.width(), 0.3));
  bar_middle_ = static_cast<float>((outermost.inner + outermost.outer) / 2);
  bar_sample_ = static_cast<std::size_t>((outermost.inner + outermost.outer) / 2 / kReach * kFoldSamples);
}

inline bool ChordFinder::could_be_one_ring(const Bar& left, const Bar& right, float half) const {
  const float a = left.width(), b = right.width();
  // One decision instead of many: which of them fails cannot be foretold.
  return (b >= narrowest_ * half - 0.7F) & (b <= widest_ * half + 1) & (a <= kWidthRatio * b + 0.8F) &
         (b <= kWidthRatio * a + 0.8F) & (left.rise < kStrengthRatio * right.fall) &
         (right.fall < kStrengthRatio * left.rise) & (left.fall < kStrengthRatio * right.rise) &
         (right.rise < kStrengthRatio * left.fall);
}

void ChordFinder::find(const LineScan& scan, const ChordSearch& search, std::vector<Chord>& chords) {
  for (std::size_t rank = 0; rank < scan.size(); ++rank) {
    const Line line = scan[rank];
    const Edges& edges = edge_finder_.find(line, search.least_rise);
    if (edges.size() < 4) continue;
    find_bars(edges);
    const auto step_px = static_cast<float>(norm(line.step));
    const float least = static_cast<float>(search.least_radius_px) / step_px;
    const float most = static_cast<float>(search.most_radius_px) / step_px;
    for (std::size_t i = 0; i < bars_.size(); ++i) {
      // A bar's own width says how large its marker can be.
      const float width = bars_[i].width();
      const float nearest = std::max(least, (width - 1) / widest_);
      const float farthest = std::min(most, (width + 0.7F) / narrowest_);
      for (std::size_t j = i + 1; j < bars_.size(); ++j) {
        const float half = (bars_[j].end - bars_[i].begin) / 2;
        if (half > farthest) break;
        if (half < nearest || !could_be_one_ring(bars_[i], bars_[j], half)) continue;
        const auto pair = symmetric_pair(line, bars_[i], bars_[j]);
        if (pair && folded(line, *pair)) match(line, *pair, search, chords);
      }
    }
  }
}

/// Noise may leave a second edge beside one of a bar's: bars with and without it are both tried.
void ChordFinder::find_bars(const Edges& edges) {
  bars_.clear();
  const std::size_t n = edges.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (edges.rise[i] < 0) continue;
    for (std::size_t j = i + 1; j < std::min(i + 3, n); ++j)
      if (edges.rise[j] < 0) bars_.push_back({edges.at[i], edges.at[j], edges.rise[i], -edges.rise[j]});
  }
}

bool ChordFinder::within(const Line& line, const Pair& pair) {
  const float left = kInside / (1 - pair.foreshortening * kInside),
              right = kInside / (1 + pair.foreshortening * kInside);
  return pair.centre() - pair.scale() * left >= 0 &&
         pair.centre() + pair.scale() * right < static_cast<float>(line.steps - 1);
}

template <std::size_t n>
void ChordFinder::read(const Line& line, const Pair& pair, const std::array<float, n>& at) {
  read_both_sides(line.values, last_place(line), pair.centre(), pair.scale(), pair.foreshortening, at.data(),
                  n, sides_.left.data(), sides_.right.data());
}

/// Of a tilted marker the nearer half is longer. A straight line through its middle is then mapped by u/(1 + v u):
/// lengths at u by 1/(1 + v u)^2, which makes the two bars unequally wide. Their widths are not exact: half that v and
/// none are tried, too.
std::optional<ChordFinder::Pair> ChordFinder::symmetric_pair(const Line& line, const Bar& left,
                                                             const Bar& right) {
  const Pair pair{(left.begin + right.end) / 2, (right.end - left.begin) / 2};
  if (!within(line, pair) || !bright_bars_in_the_dark(line, left, right)) return {};
  const float ratio = std::sqrt((left.end - left.begin) / (right.end - right.begin));
  const float v =
      std::clamp((ratio - 1) / (ratio + 1) / bar_middle_, -kMostForeshortening, kMostForeshortening);
  std::optional<Pair> best;
  float least = kGlanceAsymmetry;
  for (const float part : {0.0F, 0.5F, 1.0F}) {
    if (part > 0 && (std::abs(v) < kLeastForeshortening || least < kNoMoreAsymmetry)) break;
    const Pair foreshortened{pair.middle, pair.half, part * v};
    if (!within(line, foreshortened)) continue;
    const Glance seen = glance(line, foreshortened);
    if (seen.contrast < kLeastContrast || seen.asymmetry > kHopelessAsymmetry) break;
    if (seen.asymmetry > least) continue;
    best = foreshortened;
    least = seen.asymmetry;
  }
  return best;
}

/// The first look: two samples on each side.
bool ChordFinder::bright_bars_in_the_dark(const Line& line, const Bar& left, const Bar& right) const {
  const float half = (right.end - left.begin) / 2, most = (1 - bar_middle_) * half,
              quiet = kQuietWidth * half;
  const float a = left.begin + std::min((left.end - left.begin) / 2, most);
  const float b = right.end - std::min((right.end - right.begin) / 2, most);
  // Their sums: past one end there may be more light than past the other.
  return value_at(line, a) + value_at(line, b) - value_at(line, std::max(left.begin - quiet, 0.0F)) -
             value_at(line, std::min(right.end + quiet, last_place(line))) >
         2 * kBarOverQuiet * kLeastContrast;
}

ChordFinder::Glance ChordFinder::glance(const Line& line, const Pair& pair) {
  read(line, pair, kGlanceAt);
  float darkest = 255, brightest = 0, apart = 0;
  for (std::size_t i = 0; i < kGlances; ++i) {
    const float a = sides_.left[i], b = sides_.right[i];
    apart += std::abs(a - b);
    darkest = std::min({darkest, a, b});
    brightest = std::max({brightest, a, b});
  }
  const float contrast = brightest - darkest;
  return {contrast, apart / (kGlances * (contrast + 1e-3F))};
}

/// Makes fold_ of a pair: mean 0, square sum 1. False where it cannot be a marker's.
bool ChordFinder::folded(const Line& line, const Pair& pair) {
  read(line, pair, kFoldAt);
  float sum = 0, odd = 0;
  for (std::size_t i = 0; i < kFoldSamples; ++i) {
    const float a = sides_.left[i], b = sides_.right[i];
    fold_[i] = (a + b) / 2;
    sum += fold_[i];
    odd += (a - b) * (a - b) / 4;
  }
  const auto [darkest, brightest] = std::minmax_element(fold_.begin(), fold_.end());
  const float contrast = *brightest - *darkest;
  const float bar = *std::max_element(fold_.begin() + static_cast<int>(bar_sample_) - 1,
                                      fold_.begin() + static_cast<int>(bar_sample_) + 2);
  const float quiet = (fold_[kFoldSamples - 3] + fold_[kFoldSamples - 1]) / 2;
  if (bar - quiet < kBarOverQuiet * contrast || quiet - *darkest > kQuietOverDarkest * contrast) return false;
  const float mean = sum / kFoldSamples;
  float even = 0;
  for (float& value : fold_) {
    value -= mean;
    even += value * value;
  }
  if (even < kFoldSamples * kLeastVariance || odd > kAsymmetry * even) return false;
  const float scale = 1 / std::sqrt(even);
  for (float& value : fold_) value *= scale;
  return true;
}

void ChordFinder::match(const Line& line, const Pair& pair, const ChordSearch& search,
                        std::vector<Chord>& chords) {
  const ChordTemplates::Match found = templates_.best(fold_);
  if (found.likeness < least_likeness_) return;
  const ChordTemplates::Shape& shape = templates_.shape(found.shape);
  const double step_px = norm(line.step);
  const double scale = std::ldexp(1.0, static_cast<int>(search.level));
  Chord chord;
  chord.middle = in_full_picture(line.at(pair.centre()), search.level);
  chord.along = (1 / step_px) * line.step;
  chord.radius_px = pair.half * step_px * scale / shape.edge;
  chord.code = shape.code;
  chord.blur = shape.exposed.blur;
  chord.misalignment_rad = shape.exposed.misalignment_rad;
  chord.likeness = found.likeness;
  chord.direction = search.direction;
  chords.push_back(chord);
}

}  // namespace relock::ring
