#include "detectors/ring/candidates.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <tuple>
#include <utility>

namespace relock::ring {
namespace {

constexpr std::size_t kMostChords = 1500;     // of a picture; the others are less like a marker than these
constexpr std::size_t kMostCandidates = 300;  // of a picture
constexpr double kApart = 0.25;               // radii between the middles of chords of one marker
constexpr double kSlack_px = 2;
constexpr double kForeshortening = 4.5;  // between the radii of one marker in different directions
constexpr double kSameRadius = 1.25;

/// Total order, so that the answer does not depend on the sorting.
bool better(const Chord& a, const Chord& b) {
  const auto key = [](const Chord& chord) {
    return std::tuple(-chord.likeness, chord.middle.y, chord.middle.x, chord.direction, chord.radius_px);
  };
  return key(a) < key(b);
}

bool agree(const Chord& a, const Chord& b) {
  const double larger = std::max(a.radius_px, b.radius_px), smaller = std::min(a.radius_px, b.radius_px);
  const double tolerance = kApart * larger + kSlack_px;
  const Vec2 apart = a.middle - b.middle;
  return dot(apart, apart) < tolerance * tolerance && larger < kForeshortening * smaller;
}

/// Chords of about one radius among those of a candidate.
struct Radius {
  const Chord* best;
  int chords;
  /// The inner rings of a marker can look like a smaller marker: of equals the larger one is meant.
  double score() const {
    return best->likeness + 0.015 * std::log2(chords + 1.0) + 0.03 * std::log(best->radius_px);
  }
};

/// `chords`, best first.
const Chord& of_the_most_convincing_radius(const std::vector<Chord>& chords) {
  std::array<Radius, 16> radii{};
  std::size_t count = 0;
  for (const Chord& chord : chords) {
    const auto same = std::find_if(radii.begin(), radii.begin() + count, [&](const Radius& radius) {
      return chord.radius_px < kSameRadius * radius.best->radius_px &&
             radius.best->radius_px < kSameRadius * chord.radius_px;
    });
    if (same != radii.begin() + count)
      ++same->chords;
    else if (count < radii.size())
      radii[count++] = {&chord, 1};
  }
  return *std::max_element(radii.begin(), radii.begin() + count, [](const Radius& a, const Radius& b) {
            return a.score() < b.score();
          })->best;
}

}  // namespace

const std::vector<Candidate>& CandidateGrouper::group(std::vector<Chord>& chords) {
  std::sort(chords.begin(), chords.end(), better);
  if (chords.size() > kMostChords) chords.resize(kMostChords);
  std::move(candidates_.begin(), candidates_.end(), std::back_inserter(spare_));
  candidates_.clear();
  for (const Chord& chord : chords) {
    const auto home = std::find_if(candidates_.begin(), candidates_.end(),
                                   [&](const Candidate& candidate) { return agree(candidate.best, chord); });
    if (home != candidates_.end())
      home->chords.push_back(chord);
    else if (candidates_.size() < kMostCandidates)
      fresh(chord).chords.push_back(chord);
  }
  for (Candidate& candidate : candidates_) rank(candidate);
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.score != b.score ? a.score > b.score : better(a.best, b.best);
  });
  return candidates_;
}

Candidate& CandidateGrouper::fresh(const Chord& best) {
  if (spare_.empty()) {
    candidates_.emplace_back();
  } else {
    candidates_.push_back(std::move(spare_.back()));
    spare_.pop_back();
  }
  Candidate& candidate = candidates_.back();
  candidate.chords.clear();
  candidate.best = best;
  return candidate;
}

void CandidateGrouper::rank(Candidate& candidate) const {
  candidate.best = of_the_most_convincing_radius(candidate.chords);
  std::bitset<32> seen;
  for (const Chord& chord : candidate.chords)
    if (chord.code == candidate.best.code && chord.likeness > 0.88)
      seen.set(static_cast<std::size_t>(chord.direction));
  candidate.directions = static_cast<int>(seen.count());
  const double many = std::min(5.0, std::log2(static_cast<double>(candidate.chords.size()) + 1));
  candidate.score = candidate.best.likeness + 0.02 * many + 0.01 * candidate.directions;
}

}  // namespace relock::ring
