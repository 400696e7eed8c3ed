#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/opencv.h"
#include "detectors/part.h"
#include "detectors/ring.h"
#include "detectors/ring/finder.h"
#include "detectors/ring/likeness.h"
#include "detectors/ring/pyramid.h"
#include "detectors/ring/reading.h"
#include "detectors/ring/starts.h"

namespace relock {
namespace {

using namespace ring;

RingGeometry geometry_of(const RingOptions& options) {
  RingGeometry geometry = ring_geometry(options.geometry, options.bits);
  geometry.inverted = options.inverted;
  return geometry;
}

/// A view to start from, and how like the picture it is.
struct ScoredView {
  View view;  // px of the coarse level
  double likeness = 0;
};

class RingDetector final : public Detector {
 public:
  explicit RingDetector(const RingOptions& options)
      : options_(options),
        model_(geometry_of(options)),
        finder_(model_.geometry()),
        fitter_(model_),
        codes_(all_ring_bits(options.bits)) {}

  Sightings detect(const Image& image, const std::optional<Box>& where) override {
    if (image.empty()) throw Error("ring was given an empty picture");
    const Part part = part_to_search(image, where);
    if (std::min(part.image.size().width, part.image.size().height) < options_.min_diameter_px) return {};
    pyramid_.build(white_on_black(part.image));
    std::vector<Reading> found;
    const std::vector<Candidate>& candidates = finder_.find(pyramid_);
    look_at(candidates, &RingDetector::look_closely, found);
    // Where nothing was read, a candidate may be a marker of another radius than its best chord says.
    if (found.empty()) look_at(candidates, &RingDetector::look_at_other_radii, found);
    return sightings(found, part.offset);
  }

 private:
  using Look = std::optional<Reading> (RingDetector::*)(const Candidate&);
  /// At the best few candidates that are none of the markers found so far.
  void look_at(const std::vector<Candidate>& candidates, Look look, std::vector<Reading>& found) {
    int looked_at = 0;
    for (const Candidate& candidate : candidates) {
      if (looked_at == options_.max_candidates) break;
      if (!promising(candidate) || within_one(found, candidate)) continue;
      ++looked_at;
      if (const auto reading = (this->*look)(candidate)) keep(*reading, found);
    }
  }
  std::optional<Reading> look_at_other_radii(const Candidate& candidate) {
    Candidate other = candidate;
    for (const Chord& chord : candidate.others) {
      other.best = chord;
      if (chord.likeness < 0.88) continue;
      if (const auto reading = look_closely(other)) return reading;
    }
    return {};
  }

  cv::Mat white_on_black(const Image& image) {
    const cv::Mat gray = gray_of(image, gray_);
    if (!options_.inverted) return gray;
    cv::bitwise_not(gray, negative_);
    return negative_;
  }

  static bool promising(const Candidate& candidate) {
    const Chord& best = candidate.best;
    const bool small_and_clear = best.radius_px < 20 && best.likeness > 0.94;
    return best.likeness >= 0.9 && (candidate.chords.size() >= 3 || small_and_clear);
  }

  /// Starts, scored; a coarse fit from the best few; then the bits.
  std::optional<Reading> look_closely(const Candidate& candidate) {
    const std::size_t level = coarse_level(least_radius(candidate));
    const auto begun = scored_starts(candidate, level);
    if (begun.empty() || begun.front().likeness < 0.4) return {};
    const auto coarse = best_fit(begun, candidate.best.code, level);
    if (!coarse) return {};
    return read(pyramid_, fitter_, model_, *coarse, {});
  }

  /// Of a tilted marker the shorter radius decides what can be told apart.
  static double least_radius(const Candidate& candidate) {
    double least = candidate.best.radius_px;
    for (const Chord& chord : candidate.chords)
      if (chord.code == candidate.best.code && chord.likeness > candidate.best.likeness - 0.06 &&
          chord.radius_px > 0.2 * candidate.best.radius_px)
        least = std::min(least, chord.radius_px);
    return least;
  }

  std::vector<ScoredView> scored_starts(const Candidate& candidate, std::size_t level) {
    const int scale = 1 << level;
    const cv::Mat& gray = pyramid_.level[level];
    View here = straight_on(candidate.best.middle, candidate.best.radius_px);
    here = in_larger_pixels(here, scale);
    const LocalBlur blur = local_blur(gray, here.centre, 0.95 * here.radius());
    std::vector<ScoredView> scored;
    for (const View& start : starts(candidate, finder_.chords(), blur, 0.9 * pyramid_.full().cols)) {
      const View view = in_larger_pixels(start, scale);
      if (!view.possible() || view.radius() < 2 || view.radius() > 400) continue;
      scored.push_back({view, likeness(gray, model_, candidate.best.code, view, kCoarsePsf_px)});
    }
    std::stable_sort(scored.begin(), scored.end(),
                     [](const ScoredView& a, const ScoredView& b) { return a.likeness > b.likeness; });
    return scored;
  }

  static bool alike(const View& a, const View& b) {
    const double r = b.radius();
    const Eigen::Vector2d blur_apart = a.blur - b.blur, blur_other_way = a.blur + b.blur;
    return (a.centre - b.centre).norm() < 0.08 * r && std::abs(a.xx - b.xx) * r < 0.12 &&
           std::abs(a.xy - b.xy) * r < 0.12 && std::abs(a.yy - b.yy) * r < 0.12 &&
           (a.vanishing - b.vanishing).norm() * r < 0.03 &&
           std::min(blur_apart.norm(), blur_other_way.norm()) < 0.2 * r;
  }

  std::optional<Fit> best_fit(const std::vector<ScoredView>& begun, std::size_t code, std::size_t level) {
    std::vector<const View*> tried;
    std::optional<Fit> best;
    for (const ScoredView& start : begun) {
      if (tried.size() == kMostStarts || start.likeness < begun.front().likeness - 0.15) break;
      if (std::any_of(tried.begin(), tried.end(),
                      [&](const View* other) { return alike(*other, start.view); }))
        continue;
      tried.push_back(&start.view);
      auto fit =
          fitter_.fit(pyramid_.level[level], code, start.view,
                      {.pixels = 130, .steps = 6, .psf_px = kCoarsePsf_px, .settled = 0.1, .hopeless = 0.82});
      if (fit && (!best || fit->misfit < best->misfit)) best = fit;
      if (best && best->misfit < 0.25) break;
    }
    if (!best || best->misfit > 0.55) return {};
    best->view = in_smaller_pixels(best->view, 1 << level);
    return best;
  }

  static bool within_one(const std::vector<Reading>& found, const Candidate& candidate) {
    const Eigen::Vector2d middle(candidate.best.middle.x, candidate.best.middle.y);
    return std::any_of(found.begin(), found.end(), [&](const Reading& reading) {
      return placed(reading.fit.view, middle).q.norm() < 0.9;
    });
  }

  /// One marker is found once: of two that overlap the better one stays.
  static void keep(const Reading& reading, std::vector<Reading>& found) {
    for (Reading& other : found) {
      if (placed(other.fit.view, reading.fit.view.centre).q.norm() > 0.7) continue;
      if (reading.fit.misfit < other.fit.misfit) other = reading;
      return;
    }
    found.push_back(reading);
  }

  Sightings sightings(std::vector<Reading>& found, Vec2 offset) const {
    std::stable_sort(found.begin(), found.end(),
                     [](const Reading& a, const Reading& b) { return a.fit.misfit < b.fit.misfit; });
    Sightings all;
    for (const Reading& reading : found) {
      const View& view = reading.fit.view;
      Ellipse outline = outline_of(view);
      outline.centre = outline.centre + offset;
      all.push_back({.centre = Vec2{view.centre.x(), view.centre.y()} + offset,
                     .centre_kind = CentreKind::projected,
                     .outline = outline,
                     .code = Code{ring_family(options_.bits), codes_[reading.code]},
                     .confidence = std::clamp(1 - reading.fit.misfit, 0.0, 1.0),
                     .blur = blur_of(view)});
    }
    return all;
  }

  static constexpr double kCoarsePsf_px = 0.6;
  static constexpr std::size_t kMostStarts = 4;

  RingOptions options_;
  RingModel model_;
  CandidateFinder finder_;
  Fitter fitter_;
  std::vector<std::string> codes_;
  Pyramid pyramid_;
  cv::Mat gray_, negative_;
};

}  // namespace

std::vector<OptionInfo> ring_option_list() {
  const RingOptions d;
  return {
      {"bits", fmt::format("{}", d.bits), "", "bits of the codes: 1 to 6"},
      {"geometry", d.geometry, "", "where the rings are: paper, even, or radii (relock marker has the same)"},
      {"inverted", d.inverted ? "true" : "false", "", "true: black rings on white"},
      {"min_diameter_px", fmt::format("{}", d.min_diameter_px), "px", "smallest marker looked for"},
      {"max_candidates", fmt::format("{}", d.max_candidates), "",
       "places that are looked at closely; more is slower and finds more in clutter"},
  };
}

RingOptions ring_options(const Options& given) {
  return {.bits = given.whole("bits", 1, kMostRingBits),
          .geometry = given.word("geometry"),
          .inverted = given.flag("inverted"),
          .min_diameter_px = given.number("min_diameter_px", 10, 10000),
          .max_candidates = given.whole("max_candidates", 1, 1000)};
}

std::unique_ptr<Detector> ring_detector(const RingOptions& options) {
  return std::make_unique<RingDetector>(options);
}

}  // namespace relock
