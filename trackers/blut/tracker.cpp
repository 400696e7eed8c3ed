#include "trackers/blut/tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "trackers/blut/motion_from_blur.h"
#include "trackers/blut/occlusion.h"
#include "trackers/blut/templates.h"
#include "trackers/particles/follower.h"

namespace relock {
namespace {

using blut::Solution, blut::SparseSolver, blut::Templates;
using particles::Observations, particles::State;

/// `blut` and `l1`; its frame is ParticleFollower::follow.
class SparseFollower final : public particles::ParticleFollower {
 public:
  SparseFollower(const BlutOptions& options, std::uint64_t seed)
      : ParticleFollower(options.particles, options.proposal, seed), options_(options) {}

 private:
  void learn_start(const particles::Sampling& sampling, const State& state) override {
    templates_.emplace(sampling, state, start_size(), options_, random());
    solver_.emplace(templates_->looks(), templates_->weights(options_, std::nullopt), options_.solver);
  }

  void explain(const Observations& seen, std::vector<double>& unexplained) override;
  std::vector<std::size_t> most_promising_first(const Observations& seen);
  std::optional<BlurEstimate> read_blur(const State& state) override;
  void learn(const Eigen::Ref<const Eigen::VectorXf>& look, bool sharp) override;
  bool occluded(const Eigen::Ref<const Eigen::VectorXf>& look);
  double angle_to_best_template(const Eigen::Ref<const Eigen::VectorXf>& look) const;

  BlutOptions options_;
  std::optional<Templates> templates_;
  std::optional<SparseSolver> solver_;
  int frames_without_update_ = 0;
  // Of the frame that is being looked at.
  Eigen::VectorXf bounds_;
  Solution solution_, best_;
};

/// No particle is solved whose weight is known to be below what the others would be drawn by (Bao et al. 2012,
/// section 3.3): its bound says how well it can be explained at most.
void SparseFollower::explain(const Observations& seen, std::vector<double>& unexplained) {
  unexplained.assign(seen.usable.size(), std::numeric_limits<double>::infinity());
  if (!templates_->usable()) return;
  const double share = 1 / (2 * static_cast<double>(seen.usable.size()) - 1);
  double least_weight = 0, best = std::numeric_limits<double>::infinity();
  for (const std::size_t i : most_promising_first(seen)) {
    const auto column = static_cast<Eigen::Index>(i);
    if (options_.bound && std::exp(-options().alpha * bounds_[column]) < least_weight) break;
    solution_.coefficients.setZero(templates_->looks().cols());  // an answer depends on no other particle
    solver_->solve(seen.look.col(column), solution_);
    unexplained[i] = solution_.squared_residual;
    least_weight += share * std::exp(-options().alpha * unexplained[i]);
    if (unexplained[i] >= best) continue;
    best = unexplained[i];
    std::swap(best_, solution_);
  }
}

std::vector<std::size_t> SparseFollower::most_promising_first(const Observations& seen) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < seen.usable.size(); ++i)
    if (seen.usable[i]) order.push_back(i);
  if (!options_.bound) return order;
  solver_->bound(seen.look, bounds_);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return bounds_[static_cast<Eigen::Index>(a)] < bounds_[static_cast<Eigen::Index>(b)];
  });
  return order;
}

std::optional<BlurEstimate> SparseFollower::read_blur(const State& state) {
  if (!options_.blur_templates) return std::nullopt;
  const auto blurred = templates_->blurred(best_.coefficients);
  const double sharp = best_.coefficients.sum() - blurred.sum();
  const auto motion = blut::motion_from_blur(options_.fan, start_size().x, blurred, sharp, options_.reading);
  if (options_.direction_weight > 0) {
    const auto direction = motion ? std::optional(motion->direction_rad) : std::nullopt;
    solver_->set_weights(templates_->weights(options_, direction));
  }
  if (!motion) return std::nullopt;
  return blut::seen_at(state, *motion);
}

/// A new look takes the place of the sharp template that has the least part in the estimate. Blurred looks are not
/// learnt (Liang et al., "Blurred target tracking by blur-driven templates", ACCV 2014): sharp templates stay sharp.
void SparseFollower::learn(const Eigen::Ref<const Eigen::VectorXf>& look, bool sharp) {
  if (!options_.update) return;
  if (occluded(look)) frames_without_update_ = options_.occlusion_frames + 1;
  if (frames_without_update_ > 0) {
    --frames_without_update_;
    return;
  }
  if (!sharp || angle_to_best_template(look) <= options_.update_angle_deg) return;
  Eigen::Index least = 0;
  templates_->sharp(best_.coefficients).minCoeff(&least);
  templates_->replace(least, look);
  solver_->replace(least, look);
}

bool SparseFollower::occluded(const Eigen::Ref<const Eigen::VectorXf>& look) {
  const Eigen::VectorXf trivial = solver_->trivial(look, best_.coefficients);
  return blut::occluded_share(trivial, options().grid, options_.occlusion_level) > options_.occlusion_share;
}

double SparseFollower::angle_to_best_template(const Eigen::Ref<const Eigen::VectorXf>& look) const {
  Eigen::Index most = 0;
  templates_->sharp(best_.coefficients).maxCoeff(&most);
  const double cosine = look.dot(templates_->looks().col(most));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace

std::unique_ptr<Tracker> blut_tracker(const BlutOptions& options, std::uint64_t seed) {
  return checked_tracker("blut", [&] { return std::make_unique<SparseFollower>(options, seed); });
}

std::unique_ptr<Tracker> l1_tracker(const BlutOptions& options, std::uint64_t seed) {
  return checked_tracker("l1", [&] { return std::make_unique<SparseFollower>(options, seed); });
}

}  // namespace relock
