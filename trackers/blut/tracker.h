#pragma once

#include <memory>

#include "core/tracker.h"
#include "trackers/blut/options.h"

namespace relock {

/// The blur-driven tracker (BLUT): Wu, Ling, Yu, Li, Mei and Cheng, "Blurred target tracking by blur-driven tracker",
/// ICCV 2011, reconstructed: no implementation of it is public. docs/blut.md says what of it was read in the paper,
/// what is from the published code of the l1 tracker, and what is assumed.
///
/// Particles guess where the target is. Each is explained as a sum, without negative parts, of a few of: sharp
/// templates, templates of the target blurred in many directions and lengths, and trivial templates of a single
/// sample for what is occluded. The particle explained best is the answer. The blur templates in its sum tell the
/// motion during the exposure, which sends the next particles to both sides, along the motion.
///
/// It says a box in every frame but those without contrast (or below `least_confidence`), and does not search: what
/// moved farther than its particles reach is lost for good. Confidence is the explained part of the look. `blur` is
/// reported when the target is blurred. `expect` is honoured: most particles of the next frame go about the prior.
std::unique_ptr<Tracker> blut_tracker(const BlutOptions& options, std::uint64_t seed);

/// The l1 tracker, which BLUT extends: Mei and Ling, "Robust visual tracking and vehicle classification via sparse
/// representation", PAMI 33 (2011), with the bound, the templates and the update of Bao, Wu, Ling and Ji, CVPR 2012.
/// `options`: l1_options().
std::unique_ptr<Tracker> l1_tracker(const BlutOptions& options, std::uint64_t seed);

}  // namespace relock
