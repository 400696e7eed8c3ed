#include "trackers/blut/templates.h"

#include <cmath>

namespace relock::blut {
namespace {

constexpr double kJitter = 0.01;  // of the target's sides

}  // namespace

Templates::Templates(const particles::Sampling& sampling, const particles::State& state, Vec2 start,
                     const BlutOptions& options, Random& random)
    : sharp_(options.templates), blurred_(options.blur_templates ? options.fan.size() : 0) {
  looks_.resize(sampling.grid().size(), sharp_ + blurred_ + 1);
  for (Eigen::Index i = 0; i < sharp_; ++i) {
    particles::State at = state;
    if (i > 0) at.centre = at.centre + kJitter * Vec2{start.x * random.normal(), start.y * random.normal()};
    sampling.read(at, looks_.col(i));
    const bool contrast = particles::whiten(looks_.col(i));
    if (i == 0) usable_ = contrast;
  }
  if (blurred_ > 0)
    looks_.middleCols(sharp_, blurred_) = blurred_looks(sampling, state, options.fan, start.x);
  looks_.rightCols(1) = looks_.col(0);
}

Eigen::VectorXf Templates::weights(const BlutOptions& options, std::optional<double> last_rad) const {
  Eigen::VectorXf weights =
      Eigen::VectorXf::Constant(looks_.cols(), static_cast<float>(options.template_weight));
  for (Eigen::Index i = 0; i < blurred_; ++i) {
    const double direction = options.fan.motion(static_cast<int>(i), 1).direction_rad;
    const double across = last_rad ? 1 - std::abs(std::cos(direction - *last_rad)) : 0;
    weights[sharp_ + i] = static_cast<float>(options.blur_weight * (1 + options.direction_weight * across));
  }
  return weights;
}

}  // namespace relock::blut
