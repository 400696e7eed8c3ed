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
constexpr double kAlongBlur = 0.7;       // of the blur, beyond kApart: the best chord may be at one end of it
constexpr double kBlurred = 0.3;         // radii: shorter blurs leave the best chord near the middle
constexpr double kAlmostAsLike = 0.03;
constexpr double kRadiusOfManyChords_px = 40, kSmall_px = 17;
constexpr double kSameRadius = 1.25;
constexpr double kLongerIsBetter = 0.15;  // likeness per logarithm of the radius
constexpr std::size_t kMostRadii = 3;
constexpr double kWorthItself = 0.9;  // likeness of a radius that is a candidate by itself

/// Total order, so that the answer does not depend on the sorting.
bool better(const Chord& a, const Chord& b) {
  const auto key = [](const Chord& chord) {
    return std::tuple(-chord.likeness, chord.middle.y, chord.middle.x, chord.direction, chord.radius_px);
  };
  return key(a) < key(b);
}

/// Across a line, along the blur, a chord shows the same within a part of the blur's length.
bool agree(const Chord& best, const Chord& other) {
  const double larger = std::max(best.radius_px, other.radius_px),
               smaller = std::min(best.radius_px, other.radius_px);
  if (larger >= kForeshortening * smaller) return false;
  const Vec2 apart = other.middle - best.middle;
  const double tolerance = kApart * larger + kSlack_px;
  const double along = dot(apart, best.along), square = dot(apart, apart);
  if (square < tolerance * tolerance) return true;
  const double across = square - along * along;
  const double smeared = tolerance + kAlongBlur * best.blur * best.radius_px;
  return along * along < tolerance * tolerance && across < smeared * smeared;
}

/// Of chords alike but for where along the blur they are, the one in the middle: they lie evenly about the marker's.
const Chord& in_the_middle(const Chord& best, const std::vector<Chord>& chords) {
  if (best.blur < kBlurred) return best;
  const auto alike = [&](const Chord& chord) {
    return chord.direction == best.direction && chord.code == best.code &&
           chord.likeness > best.likeness - kAlmostAsLike && chord.radius_px < 1.1 * best.radius_px &&
           best.radius_px < 1.1 * chord.radius_px;
  };
  const auto across = [&](const Chord& chord) {
    const Vec2 apart = chord.middle - best.middle;
    return apart.y * best.along.x - apart.x * best.along.y;
  };
  double sum = 0;
  int count = 0;
  for (const Chord& chord : chords)
    if (alike(chord)) sum += across(chord), ++count;
  const Chord* middle = &best;
  for (const Chord& chord : chords)
    if (alike(chord) && std::abs(across(chord) - sum / count) < std::abs(across(*middle) - sum / count))
      middle = &chord;
  return *middle;
}

/// Lines lie some px apart. Of a small marker one that misses the middle by as much can still look like one of another
/// code, but a smaller one: the shorter chord must look clearly better.
bool more_convincing(const Chord& a, const Chord& b) {
  if (b.radius_px > kSmall_px) return false;
  return a.likeness + kLongerIsBetter * std::log(a.radius_px) >
         b.likeness + kLongerIsBetter * std::log(b.radius_px);
}

/// Chords of about one radius among those of a candidate.
struct Radius {
  const Chord* best;
  int chords;
  /// The inner rings of a marker can look like a smaller marker: of equals the larger one is meant.
  double score() const {
    return best->likeness + 0.015 * std::log2(chords + 1.0) + 0.05 * std::log(best->radius_px);
  }
};

/// The most convincing radii, kMostRadii at most. `chords`: best first.
std::vector<Radius> convincing_radii(const std::vector<Chord>& chords) {
  std::array<Radius, 16> radii{};
  std::size_t count = 0;
  for (const Chord& chord : chords) {
    const auto same = std::find_if(radii.begin(), radii.begin() + count, [&](const Radius& radius) {
      return chord.code == radius.best->code && chord.radius_px < kSameRadius * radius.best->radius_px &&
             radius.best->radius_px < kSameRadius * chord.radius_px;
    });
    if (same != radii.begin() + count) {
      ++same->chords;
      if (more_convincing(chord, *same->best)) same->best = &chord;
    } else if (count < radii.size()) {
      radii[count++] = {&chord, 1};
    }
  }
  std::stable_sort(radii.begin(), radii.begin() + count,
                   [](const Radius& a, const Radius& b) { return a.score() > b.score(); });
  return {radii.begin(), radii.begin() + std::min(count, kMostRadii)};
}

/// Likeness first. Profiles of long blurs have little of their own: much clutter is like one of them. Of a small marker
/// fewer lines see anything, and in two directions only (finder.cpp), which is not held against it.
double score(const Chord& like, const Candidate& candidate, std::size_t chords) {
  const double expected = std::clamp(like.radius_px / kRadiusOfManyChords_px, 0.25, 1.0);
  const double many = std::log2(static_cast<double>(chords) / expected + 1);
  const double directions = candidate.directions * (like.radius_px < kSmall_px ? 5 : 1);
  return like.likeness + 0.015 * std::min(5.0, many) + 0.003 * directions -
         0.05 * std::max(0.0, like.blur - 1);
}

int directions_of(const Candidate& candidate) {
  std::bitset<32> seen;
  for (const Chord& chord : candidate.chords)
    if (chord.code == candidate.best.code && chord.likeness > 0.88)
      seen.set(static_cast<std::size_t>(chord.direction));
  return static_cast<int>(seen.count());
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
  for (std::size_t i = 0, places = candidates_.size(); i < places; ++i) rank(i);
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

void CandidateGrouper::rank(std::size_t candidate) {
  const std::vector<Radius> radii = convincing_radii(candidates_[candidate].chords);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const Chord like = *radii[i].best;
    if (i > 0 && like.likeness < kWorthItself) continue;
    if (i > 0) fresh(like).chords = candidates_[candidate].chords;
    Candidate& here = i == 0 ? candidates_[candidate] : candidates_.back();
    here.best = in_the_middle(like, here.chords);
    here.directions = directions_of(here);
    here.score = score(like, here, i == 0 ? here.chords.size() : static_cast<std::size_t>(radii[i].chords));
  }
}

}  // namespace relock::ring
