#include "core/pursuit.h"

#include <algorithm>
#include <compare>
#include <utility>

#include "core/error.h"

namespace relock {
namespace {

constexpr double kReach = 2;  // sizes

struct Pair {
  bool by_place;  // pairs by code come first
  double apart;
  std::size_t claimant, detection;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

std::optional<Pair> pair_of(const std::vector<Claimant>& claimants, std::size_t c,
                            const Sightings& detections, std::size_t d) {
  const Claimant& claimant = claimants[c];
  const Sighting& seen = detections[d];
  const double apart = norm(centre_of(seen.outline) - centre_of(claimant.last)) / size_of(claimant.last);
  if (claimant.code && seen.code) {
    if (*claimant.code != *seen.code) return std::nullopt;
    return Pair{false, apart, c, d};
  }
  if (!claimant.lost && apart > kReach) return std::nullopt;
  return Pair{true, apart, c, d};
}

}  // namespace

void Pursuit::start(const Frame& frame, const Box& box, std::unique_ptr<Tracker> tracker) {
  give_up();
  tracker->start(frame, box);
  tracker_ = std::move(tracker);
}

void Pursuit::restart(std::shared_ptr<const Kept> frame, const Box& box) {
  tracker_ = nullptr;
  from_ = std::move(frame);
  box_ = box;
}

void Pursuit::give_up() {
  tracker_ = nullptr;
  from_ = nullptr;
}

std::optional<Sighting> Pursuit::track(const Frame& frame, const TrackerFactory& make_tracker,
                                       std::uint64_t& starts) {
  if (const auto from = std::exchange(from_, nullptr)) {
    tracker_ = make_tracker(starts++);
    try {
      tracker_->start({from->index, from->captured, from->picture.view()}, box_);
    } catch (const Error&) {  // a detection may be too small for it, or half out of the picture
      tracker_ = nullptr;
    }
  }
  return tracker_ ? tracker_->track(frame) : std::nullopt;
}

std::vector<std::optional<std::size_t>> claims(const std::vector<Claimant>& claimants,
                                               const Sightings& detections) {
  std::vector<Pair> pairs;
  for (std::size_t c = 0; c < claimants.size(); ++c)
    for (std::size_t d = 0; d < detections.size(); ++d)
      if (const auto pair = pair_of(claimants, c, detections, d)) pairs.push_back(*pair);
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::optional<std::size_t>> claimed(claimants.size());
  std::vector<bool> taken(detections.size(), false);
  for (const Pair& pair : pairs) {
    if (claimed[pair.claimant] || taken[pair.detection]) continue;
    claimed[pair.claimant] = pair.detection;
    taken[pair.detection] = true;
  }
  return claimed;
}

}  // namespace relock
