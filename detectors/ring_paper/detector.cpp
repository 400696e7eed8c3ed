#include "detectors/ring_paper/detector.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "core/opencv.h"
#include "detectors/part.h"
#include "detectors/ring_marker.h"

namespace relock::ring_paper {

RingPaperDetector::RingPaperDetector(const RingPaperOptions& options)
    : options_(options),
      bank_({options.wavelength_px, options.aspect, options.spread, options.kernel_px}),
      training_(shared_training(options)) {}

Sightings RingPaperDetector::detect(const Image& image, const std::optional<Box>& where) {
  if (image.empty()) throw Error("ring-paper was given an empty picture");
  const Part part = part_to_search(image, where);
  if (part.image.empty()) return {};
  look(part.image);
  return sightings(part.offset);
}

// The paper's figure 6.
const Look& RingPaperDetector::look(const Image& image) {
  look_.gray = gray_of(image, gray_);
  if (options_.inverted) look_.gray = 255 - look_.gray;
  filter();  // step 1: filtering
  look_.components = connected_components(look_.binary, options_.least_area_px, options_.most_components);
  std::vector<Vec2> centroids;
  for (const Component& part : look_.components.parts) centroids.push_back(part.centroid);
  look_.candidates.clear();
  for (const Cluster& cluster :
       clusters_within(centroids, options_.linkage_px))     // step 2: component clustering
    look_.candidates.push_back(classify_cluster(cluster));  // steps 3 and 4
  return look_;
}

void RingPaperDetector::filter() {
  const cv::Mat1f& norm = bank_.norm(look_.gray);
  double peak = options_.normalisation == Normalisation::edge ? 255 * bank_.of_edge() : 0;
  if (options_.normalisation == Normalisation::peak) {
    cv::minMaxLoc(norm, nullptr, &peak);
    peak = std::max(peak, options_.least_contrast * bank_.of_edge());
  }
  norm.convertTo(look_.response, CV_32F, 1 / peak);
  look_.binary = look_.response > options_.threshold;
}

Candidate RingPaperDetector::classify_cluster(const Cluster& cluster) const {
  const RingPaperOptions& o = options_;
  Candidate c{.cluster = cluster, .axis = {}, .profile = {}, .bars = {}};
  c.axis = principal_axis(look_.components.parts, cluster);  // step 3: dominant direction
  c.profile = intensity_profile([this](Vec2 point) { return level_at(look_.gray, point); },
                                through_box(c.axis, o.margin_px), o.scan_lines, o.scan_spacing_px);
  c.bars = bright_bars(c.profile.levels, o.binarisation, o.prominence);
  for (const Marks& marks : allowable_marks(c.bars, o.bits, o.width_tolerance)) {
    std::vector<float> levels = normalised(c.profile.levels, marks, o.samples);  // step 4: classification
    Reading reading = classify(levels, *training_, o.neighbours,
                               o.compared == Compared::count ? std::optional(marks.rings()) : std::nullopt);
    if (c.reading && c.reading->distance() <= reading.distance()) continue;
    c.marks = marks, c.normalised = std::move(levels), c.reading = std::move(reading);
  }
  c.accepted = c.reading && c.reading->distance() <= o.farthest;
  return c;
}

Sightings RingPaperDetector::sightings(Vec2 offset) const {
  std::vector<const Candidate*> accepted;
  for (const Candidate& c : look_.candidates)
    if (c.accepted) accepted.push_back(&c);
  std::stable_sort(accepted.begin(), accepted.end(), [](const Candidate* a, const Candidate* b) {
    if (a->reading->votes != b->reading->votes) return a->reading->votes > b->reading->votes;
    return a->reading->distance() < b->reading->distance();
  });
  Sightings found;
  for (const Candidate* c : accepted) {
    const double radius = c->marks->radius();
    found.push_back(sighting_of(Ellipse{c->profile.at(c->marks->middle()) + offset, radius, radius, 0}));
    found.back().code = Code{ring_family(options_.bits), c->reading->bits};
    found.back().confidence =
        static_cast<double>(c->reading->votes) / static_cast<double>(c->reading->neighbours.size());
  }
  return found;
}

}  // namespace relock::ring_paper
