#include "detectors/ring/detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/display_coding.h"
#include "core/error.h"
#include "core/opencv.h"
#include "detectors/part.h"
#include "detectors/ring/refine.h"

namespace relock::ring {
namespace {

/// `options.geometry` with what else the options say of it. Throws Error if it is none.
RingGeometry geometry_of(const RingOptions& options) {
  RingGeometry geometry = ring_geometry(options.geometry, options.bits);
  geometry.quiet_zone = options.quiet_zone;
  geometry.inverted = options.inverted;
  return geometry;
}

/// Small markers are crossed by few lines, but clear ones.
bool promising(const Candidate& candidate) {
  const Chord& best = candidate.best;
  const bool small_and_clear = best.radius_px < 20 && best.likeness > 0.94;
  return best.likeness >= 0.9 && (candidate.chords.size() >= 3 || small_and_clear);
}

/// So many candidates are glanced at for each that is looked at closely, of small ones and of others: large clutter has
/// more lines that agree.
constexpr std::size_t kGlancesPerLook = 3;
constexpr double kSmall_px = 17;
/// How much a likeness at a glance counts against the candidate's score.
constexpr double kGlanceCounts = 0.2;

/// Left unexplained by so little, a marker needs no other tone; and blurred by so little, it looks the same in all.
constexpr double kExplained = 0.15, kLeastBlur_px = 2.5;
/// A coarse fit that leaves more is of no marker, whatever the tone.
constexpr double kHopeless = 0.42;

/// Light by grey level of sRGB, 0 to 255.
cv::Mat light_of_srgb() {
  cv::Mat table(1, 256, CV_8UC1);
  for (int level = 0; level < 256; ++level)
    table.at<std::uint8_t>(level) =
        static_cast<std::uint8_t>(std::lround(255 * light_of_coded(level / 255.0)));
  return table;
}

constexpr int kColourPixels = 700;

bool within_one(const std::vector<Reading>& markers, const Candidate& candidate) {
  const Eigen::Vector2d middle(candidate.best.middle.x, candidate.best.middle.y);
  return std::any_of(markers.begin(), markers.end(),
                     [&](const Reading& marker) { return placed(marker.fit.view, middle).q.norm() < 0.9; });
}

/// One marker is found once: of two that overlap the better one stays.
void keep(const Reading& reading, std::vector<Reading>& markers) {
  for (Reading& other : markers) {
    if (placed(other.fit.view, reading.fit.view.centre).q.norm() > 0.7) continue;
    if (reading.fit.misfit < other.fit.misfit) other = reading;
    return;
  }
  markers.push_back(reading);
}

void sort_best_first(std::vector<Reading>& markers) {
  std::stable_sort(markers.begin(), markers.end(),
                   [](const Reading& a, const Reading& b) { return a.fit.misfit < b.fit.misfit; });
}

}  // namespace

RingDetector::RingDetector(const RingOptions& options)
    : options_(options),
      model_(geometry_of(options)),
      finder_(model_.geometry(), {.min_diameter_px = options.min_diameter_px}),
      fitter_(model_),
      codes_(all_ring_bits(options.bits)) {}

// The method, step by step:
// (1) chords: lines across the picture that are symmetric like lines through a marker;
// (2) candidates: places that chords agree on, best first;
// (3) starts: every view of a marker that such chords allow, scored by how like the picture it is;
// (4) fit: the picture that a moving marker leaves, fitted from the likeliest starts;
// (5) rings: how bright each ring is by itself says the bits, and whether it is a marker at all.
const Look& RingDetector::look(const Image& image) {
  look_ = {};
  light_is_made_ = false;
  look_.gray = white_on_black(image);
  if (std::min(look_.gray.cols, look_.gray.rows) < options_.min_diameter_px) return look_;
  pyramid_.build(look_.gray);
  look_.candidates = &finder_.find(pyramid_);  // 1, 2
  look_at_best();                              // 3, 4, 5
  if (options_.refine == RingRefinement::ceres) refine_markers();
  if (options_.colours) look_at_colours(image);
  sort_best_first(look_.markers);
  return look_;
}

void RingDetector::look_at_best() {
  int in_vain = 0;
  for (const Candidate* candidate : chosen_candidates()) {
    if (in_vain == options_.max_candidates) break;
    if (within_one(look_.markers, *candidate)) continue;
    look_.closely.push_back(look_closely(*candidate));
    if (const auto& reading = look_.closely.back().read)
      keep(*reading, look_.markers);
    else
      ++in_vain;
  }
}

// In clutter many places look like a marker along some line. A glance at the whole of each is quick and tells more.
std::vector<const Candidate*> RingDetector::chosen_candidates() {
  struct Glanced {
    const Candidate* candidate;
    double score;
  };
  std::size_t small = 0, large = 0;
  const auto most = kGlancesPerLook * static_cast<std::size_t>(options_.max_candidates);
  std::vector<Glanced> glanced;
  for (const Candidate& candidate : *look_.candidates) {
    std::size_t& seen = candidate.best.radius_px < kSmall_px ? small : large;
    if (!promising(candidate) || seen == most) continue;
    ++seen;
    const double likeness = glance(candidate, finder_.chords(), pyramid_, model_);
    glanced.push_back({&candidate, candidate.score + kGlanceCounts * likeness});
  }
  std::stable_sort(glanced.begin(), glanced.end(),
                   [](const Glanced& a, const Glanced& b) { return a.score > b.score; });
  std::vector<const Candidate*> chosen;
  for (const Glanced& each : glanced) chosen.push_back(each.candidate);
  return chosen;
}

Closely RingDetector::look_closely(const Candidate& candidate) {
  Closely close{&candidate, first_level(candidate), {}};
  close.starts = scored_starts(candidate, finder_.chords(), pyramid_, close.level, model_);         // 3
  close.coarse = fit_from_best(close.starts, candidate.best.code, pyramid_, close.level, fitter_);  // 4
  if (close.coarse) close.read = read_in_its_tone(*close.coarse);                                   // 5
  return close;
}

// A camera's sensor averages light, and the picture's coding then brightens the dark: edges across the blur look moved. A
// sharp marker is the same in both.
std::optional<Reading> RingDetector::read_in_its_tone(const Fit& coarse) {
  std::optional<Reading> reading;
  if (options_.tone != RingTone::light) reading = read(pyramid_, fitter_, coarse, {});
  if (options_.tone == RingTone::coded) return reading;
  const bool settled = reading && reading->fit.misfit < kExplained;
  const bool hopeless = !reading && coarse.misfit > kHopeless;
  if (options_.tone == RingTone::automatic &&
      (settled || hopeless || coarse.view.blur.norm() < kLeastBlur_px))
    return reading;
  auto other = read(in_light(), fitter_, coarse, {});
  if (!other || (reading && reading->fit.misfit <= other->fit.misfit)) return reading;
  other->in_light = true;
  return other;
}

const Pyramid& RingDetector::in_light() {
  if (!light_is_made_) {
    cv::LUT(look_.gray, light_of_srgb(), light_);
    light_pyramid_.build(light_);
    light_is_made_ = true;
  }
  return light_pyramid_;
}

// Their covariances say how well their centres and blurs are known.
void RingDetector::refine_markers() {
  const auto part = [](const auto& covariance, int x, int y) {
    return Covariance{covariance(x, x), covariance(x, y), covariance(y, y)};
  };
  for (Reading& marker : look_.markers) {
    const auto refined = refine(marker.in_light ? in_light().full() : look_.gray, model_, marker.code,
                                marker.fit, marker.psf_px);
    if (!refined) continue;
    marker.fit = refined->fit;
    marker.centre_covariance = part(refined->covariance, kCentreX, kCentreY);
    marker.blur_covariance = part(refined->covariance, kBlurX, kBlurY);
  }
}

// The rings are white: what the sheet throws back of red, green and blue light is told against them, whatever the light.
void RingDetector::look_at_colours(const Image& image) {
  if (image.format() != PixelFormat::bgr8)
    throw Error("ring(colours=true) needs pictures in colour, and this one is grey");
  for (Reading& marker : look_.markers) {
    std::array<double, 3> part{};  // blue, green, red
    for (int channel = 0; channel < 3; ++channel) {
      cv::extractChannel(read_only_mat(image), channel_, channel);
      cv::LUT(channel_, light_of_srgb(), channel_);
      const auto light = fitter_.light_in(channel_, marker.code, marker.fit.view,
                                          {.pixels = kColourPixels, .psf_px = marker.psf_px});
      if (light && light->offset + light->gain > 0)
        part.at(static_cast<std::size_t>(channel)) = light->offset / (light->offset + light->gain);
    }
    marker.sheet = nearest_sheet_colour({part[2], part[1], part[0]});
  }
}

Sightings RingDetector::detect(const Image& image, const std::optional<Box>& where) {
  const auto offset = look_at_part(image, where);
  return offset ? sightings(*offset) : Sightings{};
}

std::optional<Vec2> RingDetector::look_at_part(const Image& image, const std::optional<Box>& where) {
  if (image.empty()) throw Error("ring was given an empty picture");
  const Part part = part_to_search(image, where);
  if (part.image.empty()) return {};
  look(part.image);
  return part.offset;
}

cv::Mat RingDetector::white_on_black(const Image& image) {
  const cv::Mat gray = gray_of(image, gray_);
  if (!options_.inverted) return gray;
  cv::bitwise_not(gray, negative_);
  return negative_;
}

Sightings RingDetector::sightings(Vec2 offset) const {
  Sightings all;
  for (const Reading& marker : look_.markers) {
    const View& view = marker.fit.view;
    Ellipse outline = outline_of(view);
    outline.centre = outline.centre + offset;
    all.push_back(
        {.centre = Vec2{view.centre.x(), view.centre.y()} + offset,
         .centre_kind = CentreKind::projected,
         .outline = outline,
         .code = Code{ring_family(options_.bits), to_string(RingValue{codes_[marker.code], marker.sheet})},
         .confidence = std::clamp(1 - marker.fit.misfit, 0.0, 1.0),
         .blur = blur_of(view),
         .centre_covariance = marker.centre_covariance,
         .blur_covariance = marker.blur_covariance});
  }
  return all;
}

}  // namespace relock::ring
