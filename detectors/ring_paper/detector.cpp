#include "detectors/ring_paper/detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "core/opencv.h"
#include "detectors/part.h"
#include "detectors/ring_marker.h"

namespace relock::ring_paper {
namespace {

/// How far apart two boxes are; 0 when they touch.
double gap(const cv::Rect& a, const cv::Rect& b) {
  const int x = std::max({0, a.x - (b.x + b.width), b.x - (a.x + a.width)});
  const int y = std::max({0, a.y - (b.y + b.height), b.y - (a.y + a.height)});
  return std::hypot(x, y);
}

Things things_to_cluster(const std::vector<Component>& parts, ComponentDistance distance) {
  Things things{.count = parts.size(), .distance = {}};
  if (distance == ComponentDistance::gaps)
    things.distance = [&](std::size_t a, std::size_t b) { return gap(parts[a].box, parts[b].box); };
  else
    things.distance = [&](std::size_t a, std::size_t b) {
      return norm(parts[a].centroid - parts[b].centroid);
    };
  if (distance == ComponentDistance::pixels)
    for (const Component& part : parts) things.weights.push_back(part.area);
  return things;
}

bool better(const Candidate* a, const Candidate* b) {
  if (a->reading->votes != b->reading->votes) return a->reading->votes > b->reading->votes;
  return a->reading->distance() < b->reading->distance();
}

}  // namespace

RingPaperDetector::RingPaperDetector(const RingPaperOptions& options)
    : options_(options),
      bank_({options.wavelength_px, options.aspect, options.spread, options.kernel_px}),
      training_(shared_training(options)) {}

Sightings RingPaperDetector::detect(const Image& image, const std::optional<Box>& where) {
  const std::optional<Vec2> offset = look_at_part(image, where);
  return offset ? sightings(*offset) : Sightings{};
}

std::optional<Vec2> RingPaperDetector::look_at_part(const Image& image, const std::optional<Box>& where) {
  if (image.empty()) throw Error("ring-paper was given an empty picture");
  const Part part = part_to_search(image, where);
  if (part.image.empty()) return {};
  look(part.image);
  return part.offset;
}

// Paper, figure 6: (1) filtering, (2) component clustering, (3) dominant direction, (4) classification.
const Look& RingPaperDetector::look(const Image& image) {
  look_.gray = bright_rings(image);
  look_.response = normalised_response(look_.gray);
  look_.binary = look_.response > options_.threshold;
  look_.components = connected_components(look_.binary, options_.least_area_px, options_.most_components);
  look_.candidates.clear();
  for (const Cluster& cluster :
       clusters_within(things_to_cluster(look_.components.parts, options_.distance), options_.linkage_px)) {
    Candidate candidate{.cluster = cluster};
    candidate.axis = principal_axis(look_.components.parts, cluster);
    candidate.profile = profile_along(candidate.axis);
    candidate.bars = bright_bars(candidate.profile.levels, options_.binarisation, options_.prominence);
    read_bars(candidate);
    look_.candidates.push_back(std::move(candidate));
  }
  return look_;
}

cv::Mat1b RingPaperDetector::bright_rings(const Image& image) {
  const cv::Mat1b gray = gray_of(image, gray_);
  if (!options_.inverted) return gray;
  cv::Mat1b turned;
  cv::bitwise_not(gray, turned);
  return turned;
}

cv::Mat1f RingPaperDetector::normalised_response(const cv::Mat1b& gray) {
  const cv::Mat1f& norm = bank_.norm(gray);
  double peak = 255 * bank_.of_edge();
  if (options_.normalisation == Normalisation::peak) {
    cv::minMaxLoc(norm, nullptr, &peak);
    peak = std::max(peak, options_.least_contrast * bank_.of_edge());
  }
  norm.convertTo(look_.response, CV_32F, 1 / peak);
  return look_.response;
}

Profile RingPaperDetector::profile_along(const Axis& axis) const {
  return intensity_profile([this](Vec2 point) { return level_at(look_.gray, point); },
                           through_box(axis, options_.margin_px), options_.scan_lines,
                           options_.scan_spacing_px);
}

void RingPaperDetector::read_bars(Candidate& c) const {
  for (const Marks& marks : allowable_marks(c.bars, options_.bits, options_.width_tolerance)) {
    const auto rings = options_.compared == Compared::count ? std::optional(marks.rings()) : std::nullopt;
    std::vector<float> levels = normalised(c.profile.levels, marks, options_.samples);
    Reading reading = classify(levels, *training_, options_.neighbours, rings);
    if (c.reading && c.reading->distance() <= reading.distance()) continue;
    c.marks = marks, c.normalised = std::move(levels), c.reading = std::move(reading);
  }
  c.accepted = c.reading && c.reading->distance() <= options_.farthest;
}

std::vector<const Candidate*> RingPaperDetector::accepted() const {
  std::vector<const Candidate*> all;
  for (const Candidate& c : look_.candidates)
    if (c.accepted) all.push_back(&c);
  std::stable_sort(all.begin(), all.end(), better);
  return all;
}

Sightings RingPaperDetector::sightings(Vec2 offset) const {
  Sightings found;
  for (const Candidate* c : accepted()) {
    const double radius = c->marks->radius();
    Sighting one = sighting_of(Ellipse{c->profile.at(c->marks->middle()) + offset, radius, radius, 0});
    one.code = Code{ring_family(options_.bits), c->reading->bits};
    one.confidence = c->reading->votes / static_cast<double>(c->reading->neighbours.size());
    found.push_back(one);
  }
  return found;
}

}  // namespace relock::ring_paper
