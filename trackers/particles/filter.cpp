#include "trackers/particles/filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relock::particles {
namespace {

constexpr double kLeastScale = 0.2, kMostScale = 5;  // of the start box: beyond, a target is another one
constexpr double kLeastAspect = 0.5, kMostAspect = 2;

}  // namespace

State changed(const State& from, const ParticleOptions& o, Random& random) {
  State to = from;
  to.scale = std::clamp(from.scale * std::exp(o.scale_sigma * random.normal()), kLeastScale, kMostScale);
  to.aspect = std::clamp(from.aspect * std::exp(o.aspect_sigma * random.normal()), kLeastAspect, kMostAspect);
  to.rotation_rad = from.rotation_rad + o.rotation_sigma * random.normal();
  return to;
}

State walked(const State& from, const ParticleOptions& o, double width_px, Random& random) {
  State to = changed(from, o, random);
  to.centre.x += o.position_sigma * width_px * random.normal();
  to.centre.y += o.position_sigma * width_px * random.normal();
  return to;
}

State hinted(const State& from, const Hint& hint, const ParticleOptions& options, Vec2 start,
             Random& random) {
  const double sure = std::isfinite(hint.sigma_px) ? std::max(0.0, hint.sigma_px) : 0.0;
  const double scale = std::sqrt(hint.prior.area() / (start.x * start.y * from.aspect));
  State expected = from;
  expected.scale = std::clamp(scale, kLeastScale, kMostScale);
  expected.centre = centre_of(hint.prior) + sure * Vec2{random.normal(), random.normal()};
  return walked(expected, options, start.x * expected.scale, random);
}

std::vector<State> resampled(std::span<const double> weights, std::span<const State> particles,
                             Random& random) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double step = total / static_cast<double>(particles.size());
  const double first = random.uniform();
  std::vector<State> drawn;
  drawn.reserve(particles.size());
  std::size_t from = 0;
  double passed = weights[0];
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double at = (first + static_cast<double>(i)) * step;
    while (passed <= at && from + 1 < weights.size()) passed += weights[++from];
    drawn.push_back(particles[from]);
  }
  return drawn;
}

std::vector<OptionInfo> particle_option_list() {
  const ParticleOptions d;
  const auto text = [](auto value) { return fmt::format("{}", value); };
  return {
      {"particles", text(d.particles), "", "particles; L1-APG's demonstration has 600"},
      {"columns", text(d.grid.columns), "",
       "samples of a look across; L1-APG has 12 to 18, too few for a marker's blur"},
      {"rows", text(d.grid.rows), "", "samples of a look down"},
      {"position_sigma", text(d.position_sigma), "",
       "random walk of the place in a frame, of the target's width; assumed: with 0.04 jerks alone lose it"},
      {"scale_sigma", text(d.scale_sigma), "", "random walk of the scale in a frame; assumed"},
      {"rotation_sigma", text(d.rotation_sigma), "rad", "random walk of the rotation in a frame; assumed"},
      {"aspect_sigma", text(d.aspect_sigma), "", "random walk of the aspect in a frame; assumed"},
      {"alpha", text(d.alpha), "",
       "a particle's weight is exp(-alpha r), r the unexplained part of what it sees; L1-APG's"},
      {"least_confidence", text(d.least_confidence), "",
       "explained part below which the target is called lost; 0 as published: never"}};
}

ParticleOptions particle_options(const Options& given) {
  return {.particles = given.whole("particles", 10, 100'000),
          .grid = {given.whole("columns", 4, 100), given.whole("rows", 4, 100)},
          .position_sigma = given.number("position_sigma", 0, 10),
          .scale_sigma = given.number("scale_sigma", 0, 1),
          .rotation_sigma = given.number("rotation_sigma", 0, 3),
          .aspect_sigma = given.number("aspect_sigma", 0, 1),
          .alpha = given.number("alpha", 0, 10'000),
          .least_confidence = given.number("least_confidence", 0, 1)};
}

}  // namespace relock::particles
