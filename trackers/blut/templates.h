#pragma once

#include <Eigen/Core>

#include "core/random.h"
#include "trackers/blut/options.h"
#include "trackers/particles/sampling.h"

namespace relock::blut {

/// The looks that explain a target: sharp ones, which are updated; blurred ones and the first look, which are not.
class Templates {
 public:
  /// From the picture shown to `sampling`, in which the target is at `state`. The sharp templates are the target's
  /// look there and, 1 % of its size about it, where a tracker would also say that it is.
  Templates(const particles::Sampling& sampling, const particles::State& state, Vec2 start,
            const BlutOptions& options, Random& random);

  /// A column each: sharp, blurred, first.
  const Eigen::MatrixXf& looks() const { return looks_; }
  /// Whether the target had any contrast: if not, nothing explains it and it explains nothing.
  bool usable() const { return usable_; }

  /// The weight of each template. After a blur in direction `last_rad` (in the start picture), templates that blur
  /// across it are dearer: w (1 + g (1 - |cos|)), g being BlutOptions::direction_weight.
  Eigen::VectorXf weights(const BlutOptions& options, std::optional<double> last_rad) const;

  auto sharp(const Eigen::VectorXf& coefficients) const { return coefficients.head(sharp_); }
  auto blurred(const Eigen::VectorXf& coefficients) const { return coefficients.segment(sharp_, blurred_); }

  /// Puts a look in place of a sharp template.
  void replace(Eigen::Index sharp, const Eigen::Ref<const Eigen::VectorXf>& look) {
    looks_.col(sharp) = look;
  }

 private:
  Eigen::Index sharp_, blurred_;
  Eigen::MatrixXf looks_;
  bool usable_ = false;
};

}  // namespace relock::blut
