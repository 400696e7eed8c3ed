#pragma once

#include <optional>
#include <vector>

#include "detectors/ring/fit.h"
#include "detectors/ring/pyramid.h"
#include "detectors/ring/starts.h"

namespace relock::ring {

/// A view to start from, and how like the picture it is.
struct ScoredView {
  View view;  ///< px of the level that it was scored on
  double likeness = 0;
};

/// The level of the pyramid on which a candidate is looked at first: that which shows its radius with 14 to 28 px, or
/// as nearly so as there is one. Of a tilted marker the shorter radius decides what can be told apart.
std::size_t first_level(const Candidate& candidate);

/// How like the picture the likeliest of a candidate's plain starts is, to 1: a first glance.
double glance(const Candidate& candidate, const std::vector<Chord>& chords, const Pyramid& pyramid,
              RingModel& model);

/// The likeliest of the views from which a fit may start, best first. `chords`: all of the picture.
std::vector<ScoredView> scored_starts(const Candidate& candidate, const std::vector<Chord>& chords,
                                      const Pyramid& pyramid, std::size_t level, RingModel& model);

/// Standard deviation of lens and pixel that the coarse fit takes for granted, px of its level. Softer rings catch a view
/// from farther away, but those of a small marker would run into one another.
double coarse_psf_px(const View& view);

/// The best fit from the likeliest starts that differ, px of the full picture. Nothing where no marker explains what is
/// seen even roughly.
std::optional<Fit> fit_from_best(const std::vector<ScoredView>& starts, std::size_t code,
                                 const Pyramid& pyramid, std::size_t level, Fitter& fitter);

}  // namespace relock::ring
