#include "detectors/ring/ring_model.h"

#include <algorithm>
#include <cmath>

namespace relock::ring {
namespace {

// A table for every third more of sigma: blur hides finer differences. Thinner than the tables' step it is not.
constexpr double kLeastSigma = 0.012, kRatio = 1.3;
constexpr int kLevels = 10;

}  // namespace

const SweptProfile& MovingRings::swept(double sigma) {
  const double level = std::log(sigma / kLeastSigma) / std::log(kRatio);
  const int nearest = std::clamp(static_cast<int>(std::lround(level)), 0, kLevels - 1);
  auto found = swept_.find(nearest);
  if (found == swept_.end())
    found = swept_.emplace(nearest, SweptProfile(still_, kLeastSigma * std::pow(kRatio, nearest))).first;
  return found->second;
}

RingModel::RingModel(const RingGeometry& geometry)
    : geometry_(geometry), sheet_({{0, geometry.quiet_zone + geometry.soft_border / 2}}) {
  for (const std::string& bits : all_ring_bits(geometry.bits()))
    codes_.emplace_back(rings_of({geometry, bits}));
  double edge = 0;
  for (const Annulus& slot : geometry.slots) {
    slots_.emplace_back(std::vector{slot});
    if (slot.inner > edge) gaps_.emplace_back(std::vector<Annulus>{{edge, slot.inner}});
    edge = slot.outer;
  }
}

}  // namespace relock::ring
