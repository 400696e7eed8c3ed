#pragma once

#include <optional>
#include <vector>

#include "detectors/ring/fit.h"
#include "detectors/ring/pyramid.h"

namespace relock::ring {

/// What a reading must be to count.
struct Acceptance {
  double most_misfit = 0.36;
  /// Of a sharp marker, and how much more for each radius of blur: what is around the sheet is not one level.
  double most_structure = 0.12, structure_per_blur = 0.1;
  /// Of the bound on the misfit where the picture is less sharp than any that is tried.
  double unsharp = 0.6;
  double most_doubt = 0.07;
  /// Misfit, structure and doubt, each in parts of its bound, are this on average at most: clutter may come near all three.
  double most_together = 0.7;
  double most_light_between = 0.15;            ///< rings, in gaps that are told apart
  double least_gain = 25;                      ///< grey levels from black to white
  double least_black = -15, most_white = 275;  ///< grey levels
};

/// A marker that was read.
struct Reading {
  Fit fit;  ///< in px of the full picture
  std::size_t code = 0;
  double psf_px = 0;
  /// How far the light of a ring is from what its code says at most, in parts of white: always white ones from
  /// each other, bits from black or white.
  double doubt = 1;
  std::vector<Fitter::AnnulusLight> lights;  ///< of each ring, as Fitter::RingLights has them
  SheetColour sheet = SheetColour::black;    ///< where colours are asked for
  bool in_light = false;                     ///< read where grey levels are proportional to light
  std::optional<Covariance> centre_covariance = {}, blur_covariance = {};  ///< px^2, of a refined fit
};

/// Reads the bits of a marker about whose view `coarse` is right: each ring's own light says whether it is there. Then
/// fits once more with that code, finely and with the sharpness of this picture, and reads again, until code and view
/// agree. Nothing where they do not.
std::optional<Reading> read(const Pyramid& pyramid, Fitter& fitter, const Fit& coarse,
                            const Acceptance& acceptance);

}  // namespace relock::ring
