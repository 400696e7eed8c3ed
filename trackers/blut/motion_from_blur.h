#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/sighting.h"
#include "trackers/blut/blurred_looks.h"

namespace relock::blut {

/// How a blur is read off the coefficients.
struct BlurReading {
  enum class Length {
    spread,  ///< root of the mean square, templates that are not blurred counting as 0
    mean,    ///< mean over the blur templates
  };
  double blurred_share = 0.4;  ///< of all coefficients, above which the target may be blurred
  double least_blur = 0.08;    ///< of the target's width: shorter ones are no blur
  Length length = Length::spread;
};

/// The motion during the exposure that the coefficients of the blur templates tell, in the start picture: nothing
/// when the target is sharp. `sharp`: sum of the coefficients of all templates that are not blurred.
///
/// The direction is the one whose templates have the largest sum, refined with its two neighbours as the mean of
/// doubled angles (a direction has no sense). The length is that of one motion which spreads a point as far as the sum
/// of these templates, and of the sharp ones, does: a motion of length l spreads it by l^2 / 12, and spreads in a sum
/// are averaged. (The mean length of the blur templates alone, which the paper is recalled to take, is too long by half
/// for short blurs: those are told as a sum of sharp templates and long ones.)
std::optional<BlurEstimate> motion_from_blur(const BlurFan& fan, double width_px,
                                             const Eigen::Ref<const Eigen::VectorXf>& coefficients,
                                             double sharp, const BlurReading& reading);

/// The same motion as seen on the target at `state`.
BlurEstimate seen_at(const particles::State& state, const BlurEstimate& motion);

}  // namespace relock::blut
