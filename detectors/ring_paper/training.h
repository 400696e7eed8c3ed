#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "detectors/ring_paper.h"

namespace relock::ring_paper {

/// What a blurred marker looks like along the line across the blur.
struct TrainingProfile {
  std::string bits;
  int orientation_deg = 0;  ///< of the blur
  std::vector<float> levels;
};

/// Figure 7 of the paper: for each code of the options' bits the marker is drawn, blurred along 36 orientations (0,
/// 10, …, 350), and its profile along the first principal component taken. That is the line across the blur
/// through the middle, because marker and blur are their own mirror images there; no filter is asked for it.
/// Throws Error for a geometry that is none.
std::vector<TrainingProfile> training_profiles(const RingPaperOptions& options);

/// The same, made once for all detectors of the same options.
std::shared_ptr<const std::vector<TrainingProfile>> shared_training(const RingPaperOptions& options);

/// A training profile near to one that is asked about.
struct Neighbour {
  std::size_t rank = 0;  ///< in the training profiles
  float distance = 0;    ///< root mean square of the differences of the levels
};

struct Reading {
  std::string bits;
  int votes = 0;
  std::vector<Neighbour> neighbours;  ///< the K nearest, nearest first, at least one
  float distance() const { return neighbours.front().distance; }
};

/// The code that most of the K nearest training profiles have; of codes with equally many the one that is nearest.
/// `rings`: compare only with codes of so many rings.
Reading classify(const std::vector<float>& levels, const std::vector<TrainingProfile>& training, int k,
                 std::optional<int> rings);

}  // namespace relock::ring_paper
