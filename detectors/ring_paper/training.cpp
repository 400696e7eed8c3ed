#include "detectors/ring_paper/training.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "core/blur.h"
#include "detectors/ring_marker.h"
#include "detectors/ring_paper/profile.h"

namespace relock::ring_paper {
namespace {

constexpr int kStep_deg = 10;  // 36 orientations, as printed

/// A pixel of a kernel that is not 0.
struct Tap {
  int x = 0, y = 0;
  float weight = 0;
};

std::vector<Tap> taps_of(const cv::Mat1f& kernel) {
  std::vector<Tap> taps;
  for (int y = 0; y < kernel.rows; ++y)
    for (int x = 0; x < kernel.cols; ++x)
      if (kernel(y, x) != 0) taps.push_back({x - kernel.cols / 2, y - kernel.rows / 2, kernel(y, x)});
  return taps;
}

/// One ring, white on black, about the middle pixel; each pixel is the mean over its area.
cv::Mat1f drawn(const Annulus& ring, double radius_px, int half) {
  constexpr int kParts = 4;  // of a pixel, in each direction
  cv::Mat1f picture(2 * half + 1, 2 * half + 1);
  for (int y = 0; y <= half; ++y)
    for (int x = 0; x <= half; ++x) {
      int white = 0;
      for (int part = 0; part < kParts * kParts; ++part) {
        const double dx = x + (part % kParts + 0.5) / kParts - 0.5;
        const double dy = y + (part / kParts + 0.5) / kParts - 0.5;
        const double rho = std::hypot(dx, dy) / radius_px;
        white += ring.inner <= rho && rho < ring.outer;
      }
      picture(half + y, half + x) = picture(half + y, half - x) = picture(half - y, half + x) =
          picture(half - y, half - x) = 255.0F * static_cast<float>(white) / (kParts * kParts);
    }
  return picture;
}

/// A picture that is blurred only where it is looked at: that is along a few lines.
class BlurredPicture {
 public:
  BlurredPicture(const cv::Mat1f& sharp, const std::vector<Tap>& taps)
      : sharp_(sharp), taps_(taps), known_(sharp.size(), kUnknown) {}

  float level_at(Vec2 point) {
    const int x = static_cast<int>(std::floor(point.x)), y = static_cast<int>(std::floor(point.y));
    const auto fx = static_cast<float>(point.x - x), fy = static_cast<float>(point.y - y);
    return (1 - fy) * ((1 - fx) * pixel(x, y) + fx * pixel(x + 1, y)) +
           fy * ((1 - fx) * pixel(x, y + 1) + fx * pixel(x + 1, y + 1));
  }

 private:
  static constexpr float kUnknown = -1;

  float pixel(int x, int y) {
    float& level = known_(y, x);
    if (level != kUnknown) return level;
    level = 0;
    for (const Tap& tap : taps_) level += tap.weight * sharp_(y + tap.y, x + tap.x);
    return level;
  }

  const cv::Mat1f& sharp_;
  const std::vector<Tap>& taps_;
  cv::Mat1f known_;
};

/// How far the profile reaches from the middle.
double reach_of(const RingPaperOptions& options) { return 1.15 * options.training_marker_px / 2; }

/// Each ring alone, with room for the lines and the blur.
std::vector<cv::Mat1f> drawn_rings(const RingPaperOptions& options, const std::vector<Annulus>& rings) {
  const double aside = (options.scan_lines - 1) / 2.0 * options.scan_spacing_px;
  const int half = static_cast<int>(std::ceil(reach_of(options) + aside + options.training_blur_px / 2)) + 3;
  std::vector<cv::Mat1f> pictures;
  for (const Annulus& ring : rings) pictures.push_back(drawn(ring, options.training_marker_px / 2, half));
  return pictures;
}

/// The profile of each ring alone, blurred at this orientation. That of a marker is the sum of those of its rings,
/// because blurring and averaging are linear and rings share no point: so the time does not double with each bit.
std::vector<std::vector<float>> profiles_of_rings(const RingPaperOptions& options,
                                                  const std::vector<cv::Mat1f>& rings,
                                                  double orientation_rad) {
  const double half = rings.front().cols / 2;
  const Vec2 middle{half, half};
  const Vec2 across = reach_of(options) * Vec2{-std::sin(orientation_rad), std::cos(orientation_rad)};
  const std::vector<Tap> taps = taps_of(blur_kernel({orientation_rad, options.training_blur_px}));
  std::vector<std::vector<float>> profiles;
  for (const cv::Mat1f& ring : rings) {
    BlurredPicture blurred(ring, taps);
    profiles.push_back(intensity_profile([&](Vec2 point) { return blurred.level_at(point); },
                                         {middle - across, middle + across}, options.scan_lines,
                                         options.scan_spacing_px)
                           .levels);
  }
  return profiles;
}

std::vector<float> sum_of_rings(const std::vector<std::vector<float>>& profiles,
                                const std::vector<Annulus>& slots, const std::vector<Annulus>& rings) {
  std::vector<float> sum(profiles.front().size(), 0.0F);
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    if (std::find(rings.begin(), rings.end(), slots[slot]) == rings.end()) continue;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += profiles[slot][i];
  }
  return sum;
}

/// All bars there are, because nothing else is in the picture; one at least, because it is black at both ends.
Marks marks_of(const std::vector<float>& levels, const RingPaperOptions& options) {
  return {bright_bars(levels, Binarisation::local, options.prominence)};
}

}  // namespace

std::vector<TrainingProfile> training_profiles(const RingPaperOptions& options) {
  const RingGeometry geometry = ring_geometry(options.geometry, options.bits);
  const std::vector<std::string> codes = all_ring_bits(options.bits);
  const std::vector<cv::Mat1f> sharp = drawn_rings(options, geometry.slots);
  std::vector<TrainingProfile> all;
  for (int turned = 0; turned < 180; turned += kStep_deg) {
    const auto of_rings = profiles_of_rings(options, sharp, turned * std::numbers::pi / 180);
    for (const std::string& bits : codes) {
      const std::vector<float> levels = sum_of_rings(of_rings, geometry.slots, rings_of({geometry, bits}));
      std::vector<float> one = normalised(levels, marks_of(levels, options), options.samples);
      // A motion has no sign: half a turn on, the same picture is read from its other end.
      std::vector<float> other(one.rbegin(), one.rend());
      all.push_back({bits, turned, std::move(one)});
      all.push_back({bits, turned + 180, std::move(other)});
    }
  }
  return all;
}

std::shared_ptr<const std::vector<TrainingProfile>> shared_training(const RingPaperOptions& options) {
  static std::mutex guard;
  static std::map<std::string, std::weak_ptr<const std::vector<TrainingProfile>>> made;
  const std::string key =
      fmt::format("{} {} {} {} {} {} {} {}", options.bits, options.geometry, options.training_marker_px,
                  options.training_blur_px, options.scan_lines, options.scan_spacing_px, options.prominence,
                  options.samples);
  const std::lock_guard lock(guard);
  auto training = made[key].lock();
  if (!training) {
    training = std::make_shared<const std::vector<TrainingProfile>>(training_profiles(options));
    made[key] = training;
  }
  return training;
}

Reading classify(const std::vector<float>& levels, const std::vector<TrainingProfile>& training, int k,
                 std::optional<int> rings) {
  std::vector<Neighbour> all;
  for (std::size_t i = 0; i < training.size(); ++i) {
    const auto ones = std::count(training[i].bits.begin(), training[i].bits.end(), '1');
    if (rings && ones + 2 != *rings) continue;
    double squares = 0;
    for (std::size_t s = 0; s < levels.size(); ++s) {
      const double difference = levels[s] - training[i].levels[s];
      squares += difference * difference;
    }
    all.push_back({i, static_cast<float>(std::sqrt(squares / static_cast<double>(levels.size())))});
  }
  const std::size_t count = std::min(all.size(), static_cast<std::size_t>(k));
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                    [](const Neighbour& a, const Neighbour& b) {
                      return a.distance != b.distance ? a.distance < b.distance : a.rank < b.rank;
                    });
  all.resize(count);
  Reading reading{.bits = {}, .votes = 0, .neighbours = all};
  for (const Neighbour& one : all) {  // nearest first: of equally many votes the nearest stays
    const std::string& bits = training[one.rank].bits;
    const auto votes = std::count_if(all.begin(), all.end(),
                                     [&](const Neighbour& n) { return training[n.rank].bits == bits; });
    if (votes > reading.votes) reading.votes = static_cast<int>(votes), reading.bits = bits;
  }
  return reading;
}

}  // namespace relock::ring_paper
