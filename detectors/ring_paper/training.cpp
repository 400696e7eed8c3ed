#include "detectors/ring_paper/training.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "core/blur.h"
#include "core/error.h"
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

/// The marker about the middle pixel, each pixel the mean over its area, with black around it: what lies beyond
/// the quiet zone is not the marker's.
cv::Mat1f drawn(const RingMarker& marker, double radius_px, int half) {
  constexpr int kParts = 4;  // of a pixel, in each direction
  cv::Mat1f picture(2 * half + 1, 2 * half + 1);
  for (int y = 0; y <= half; ++y)
    for (int x = 0; x <= half; ++x) {
      double sum = 0;
      for (int part = 0; part < kParts * kParts; ++part) {
        const double rho =
            std::hypot(x + (part % kParts + 0.5) / kParts - 0.5, y + (part / kParts + 0.5) / kParts - 0.5) /
            radius_px;
        sum += rho < marker.geometry.quiet_zone ? reflectance(marker, rho) : 0;
      }
      picture(half + y, half + x) = picture(half + y, half - x) = picture(half - y, half + x) =
          picture(half - y, half - x) = static_cast<float>(255 * sum / (kParts * kParts));
    }
  return picture;
}

float blurred_pixel(const cv::Mat1f& picture, const std::vector<Tap>& taps, int x, int y) {
  float sum = 0;
  for (const Tap& tap : taps) sum += tap.weight * picture(y + tap.y, x + tap.x);
  return sum;
}

/// Blurred only where the profile passes.
float blurred_at(const cv::Mat1f& picture, const std::vector<Tap>& taps, Vec2 point) {
  const int x = static_cast<int>(std::floor(point.x)), y = static_cast<int>(std::floor(point.y));
  const auto fx = static_cast<float>(point.x - x), fy = static_cast<float>(point.y - y);
  return (1 - fy) *
             ((1 - fx) * blurred_pixel(picture, taps, x, y) + fx * blurred_pixel(picture, taps, x + 1, y)) +
         fy * ((1 - fx) * blurred_pixel(picture, taps, x, y + 1) +
               fx * blurred_pixel(picture, taps, x + 1, y + 1));
}

/// The bars of a training profile: all there are, because nothing else is in the picture.
Marks marks_of(const std::vector<float>& levels, const RingPaperOptions& options) {
  Marks marks{bright_bars(levels, Binarisation::local, options.prominence)};
  if (marks.bars.empty())
    throw Error(
        fmt::format("ring-paper cannot be trained: a blur of {} px leaves nothing to be seen of a marker "
                    "of {} px; choose another training_blur_px",
                    options.training_blur_px, options.training_marker_px));
  return marks;
}

}  // namespace

std::vector<TrainingProfile> training_profiles(const RingPaperOptions& options) {
  const RingGeometry geometry = ring_geometry(options.geometry, options.bits);
  const double radius = options.training_marker_px / 2, reach = 1.15 * radius;
  const double aside = (options.scan_lines - 1) / 2.0 * options.scan_spacing_px;
  const int half = static_cast<int>(std::ceil(reach + aside + options.training_blur_px / 2)) + 3;
  const Vec2 middle{static_cast<double>(half), static_cast<double>(half)};

  std::vector<TrainingProfile> all;
  for (const std::string& bits : all_ring_bits(options.bits)) {
    const cv::Mat1f picture = drawn({geometry, bits}, radius, half);
    for (int turned = 0; turned < 360; turned += kStep_deg) {
      const double direction = turned * std::numbers::pi / 180;
      const std::vector<Tap> taps = taps_of(blur_kernel({direction, options.training_blur_px}));
      const Vec2 across{-std::sin(direction), std::cos(direction)};
      const Profile profile = intensity_profile([&](Vec2 point) { return blurred_at(picture, taps, point); },
                                                {middle - reach * across, middle + reach * across},
                                                options.scan_lines, options.scan_spacing_px);
      all.push_back(
          {bits, turned, normalised(profile.levels, marks_of(profile.levels, options), options.samples)});
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
