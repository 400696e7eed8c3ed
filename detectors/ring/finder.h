#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "detectors/ring/candidates.h"
#include "detectors/ring/chords.h"
#include "detectors/ring/line_scan.h"
#include "detectors/ring/pyramid.h"
#include "detectors/ring_marker.h"

namespace relock::ring {

struct FinderOptions {
  double min_diameter_px = 16;  ///< smallest marker looked for
  double max_diameter_px = 0;   ///< largest; 0: as large as the picture
  double most_blur = 2;         ///< longest blur looked for, parts of the radius
  double least_likeness = 0.8;  ///< of a chord
};

/// Finds where ring markers may be: from a grey picture to an ordered list of candidates.
///
/// A line across a marker's middle shows bars that are symmetric about it, and a line square to a motion blur shows
/// them unblurred where it leaves the rings' ends. So (1) lines in eight directions are read off the picture, (2) every
/// two bars along one that may be a marker's outermost ring are compared with what lines through markers look like,
/// and (3) chords that agree on a middle are a candidate.
///
/// One object serves one thread. It keeps buffers, never answers: the same picture gives the same candidates.
class CandidateFinder {
 public:
  explicit CandidateFinder(const RingGeometry& geometry, const FinderOptions& options = {});

  /// Best first; valid until the next call. The picture shows white rings on black: of inverted markers, it is the
  /// negative.
  const std::vector<Candidate>& find(const Pyramid& pyramid);
  /// All chords of the last picture, of which candidates were made.
  const std::vector<Chord>& chords() const { return chords_; }

 private:
  FinderOptions options_;
  ChordFinder chord_finder_;
  CandidateGrouper grouper_;
  LineScan scan_;
  std::array<cv::Mat, Pyramid::kLevels> transposed_;
  std::vector<Chord> chords_;
};

}  // namespace relock::ring
