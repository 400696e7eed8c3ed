#pragma once

#include <map>
#include <memory>
#include <vector>

#include "detectors/ring/radial_profile.h"
#include "detectors/ring/swept_profile.h"
#include "detectors/ring_marker.h"

namespace relock::ring {

/// The light of one set of annuli under any movement.
class MovingRings {
 public:
  explicit MovingRings(const std::vector<Annulus>& annuli) : still_(annuli) {}

  const RadialProfile& still() const { return still_; }
  /// For long movements, of the nearest sigma that tables are made for. The first call for a sigma takes some
  /// milliseconds.
  const SweptProfile& swept(double sigma);

 private:
  RadialProfile still_;
  std::map<int, SweptProfile> swept_;
};

/// Everything that a marker of one geometry can show: each of its codes, each of its rings by itself, and the
/// black sheet. Bits count from the ring nearest to the middle: code 1 is "01".
class RingModel {
 public:
  explicit RingModel(const RingGeometry& geometry);

  const RingGeometry& geometry() const { return geometry_; }
  std::size_t codes() const { return codes_.size(); }
  std::size_t slots() const { return slots_.size(); }
  MovingRings& code(std::size_t number) { return codes_[number]; }
  MovingRings& slot(std::size_t number) { return slots_[number]; }
  /// The black annuli within the outermost ring: what is inside of each slot, if anything is.
  std::size_t gaps() const { return gaps_.size(); }
  MovingRings& gap(std::size_t number) { return gaps_[number]; }
  /// The disc of the quiet zone: where it has no light, the surroundings are seen.
  MovingRings& sheet() { return sheet_; }

 private:
  RingGeometry geometry_;
  std::vector<MovingRings> codes_, slots_, gaps_;
  MovingRings sheet_;
};

}  // namespace relock::ring
