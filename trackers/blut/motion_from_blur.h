#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/sighting.h"
#include "trackers/blut/blurred_looks.h"

namespace relock::blut {

/// The motion during the exposure that the coefficients of the blur templates tell, in the start picture: nothing
/// when the target is sharp, that is, when the blur templates have no more than `blurred_share` of all coefficients.
///
/// The direction is the one whose templates have the largest sum, refined with its two neighbours as the mean of
/// doubled angles (a direction has no sense), and the length is the mean of the lengths of these templates, weighted
/// by their coefficients. `sharp`: sum of the coefficients of all templates that are not blurred.
std::optional<BlurEstimate> motion_from_blur(const BlurFan& fan, double width_px,
                                             const Eigen::Ref<const Eigen::VectorXf>& coefficients,
                                             double sharp, double blurred_share);

/// The same motion as seen on the target at `state`.
BlurEstimate seen_at(const particles::State& state, const BlurEstimate& motion);

}  // namespace relock::blut
