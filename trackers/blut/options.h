#pragma once

#include <vector>

#include "core/options.h"
#include "trackers/blut/blurred_looks.h"
#include "trackers/blut/motion_from_blur.h"
#include "trackers/blut/sparse_solver.h"
#include "trackers/particles/filter.h"
#include "trackers/particles/proposal.h"

namespace relock {

/// Of `blut`, and of `l1` as far as they do not concern blur. docs/blut.md says where each value comes from.
struct BlutOptions {
  particles::ParticleOptions particles = {};
  particles::ProposalOptions proposal = {};
  blut::BlurFan fan = {};
  blut::SolverOptions solver = {};
  int templates = 10;             ///< sharp ones, that are updated
  double template_weight = 0.01;  ///< w of the sharp templates
  double blur_weight = 0.01;      ///< w of the blur templates
  double direction_weight = 0;    ///< how much dearer templates are that blur across the last blur
  blut::BlurReading reading = {};
  double update_angle_deg = 20;   ///< between a look and its best template, above which it becomes one
  double occlusion_level = 0.4;   ///< of a look's standard deviation: a sample that no template explains
  double occlusion_share = 0.25;  ///< of the grid, in one piece, above which the target is occluded
  int occlusion_frames = 5;       ///< without update after an occlusion
  bool blur_templates = true;
  bool update = true;
  bool bound = true;  ///< particles that cannot matter are not solved
};
std::vector<OptionInfo> blut_option_list();
/// Throws Error naming the option, the value and the legal range.
BlutOptions blut_options(const Options& given);

std::vector<OptionInfo> l1_option_list();
/// The same tracker without blur templates and without lobes.
BlutOptions l1_options(const Options& given);

}  // namespace relock
