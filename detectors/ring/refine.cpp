#include "detectors/ring/refine.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relock::ring {
namespace {

using Unknowns = std::array<double, kUnknowns>;

constexpr int kMostSteps = 25;
/// More pixels than any marker has: then every one is looked at.
constexpr int kEveryPixel = 1 << 24;
/// A priori, standard deviations, so that what a picture does not show (which way a sharp marker moves, say) is
/// uncertain and not undetermined: v R, how fast a marker gets smaller over its radius; blur, radii; leak, grey levels.
constexpr double kUsualPerspective = 0.15, kUsualBlur = 1, kUsualLeak = 100;

/// The unknowns in units in which one makes about as much of a difference as another: px at the outermost ring, and tens
/// of grey levels.
class Scaled {
 public:
  explicit Scaled(double radius) {
    unit_.fill(1);
    for (const int k : {kXX, kXY, kYY, kVanishingX, kVanishingY})
      unit_[static_cast<std::size_t>(k)] = 1 / (radius * radius);
    for (const int k : {kGain, kOffset, kLeak}) unit_[static_cast<std::size_t>(k)] = 10;
  }

  double unit(int unknown) const { return unit_[static_cast<std::size_t>(unknown)]; }
  Unknowns of(const View& view, const Light& light) const {
    Unknowns u{};
    u[kCentreX] = view.centre.x(), u[kCentreY] = view.centre.y();
    u[kXX] = view.xx, u[kXY] = view.xy, u[kYY] = view.yy;
    u[kBlurX] = view.blur.x(), u[kBlurY] = view.blur.y();
    u[kGain] = light.gain, u[kOffset] = light.offset, u[kLeak] = light.leak;
    u[kVanishingX] = view.vanishing.x(), u[kVanishingY] = view.vanishing.y();
    for (std::size_t k = 0; k < u.size(); ++k) u[k] /= unit_[k];
    return u;
  }
  View view(const double* u) const {
    const auto at = [&](int k) { return u[k] * unit(k); };
    View view;
    view.centre = {at(kCentreX), at(kCentreY)};
    view.xx = at(kXX), view.xy = at(kXY), view.yy = at(kYY);
    view.blur = {at(kBlurX), at(kBlurY)};
    view.vanishing = {at(kVanishingX), at(kVanishingY)};
    return view;
  }
  Light light(const double* u) const {
    return {u[kOffset] * unit(kOffset), u[kGain] * unit(kGain), u[kLeak] * unit(kLeak)};
  }

 private:
  Unknowns unit_;
};

/// What every pixel shows beside what it should show, in standard deviations of the noise.
class EveryPixel final : public ceres::CostFunction {
 public:
  EveryPixel(RingModel& model, std::size_t code, const Samples& samples, const Scaled& scaled, double psf_px,
             double noise)
      : model_(model), code_(code), samples_(samples), scaled_(scaled), psf_px_(psf_px), noise_(noise) {
    mutable_parameter_block_sizes()->push_back(kUnknowns);
    set_num_residuals(static_cast<int>(samples.size()));
  }

  bool Evaluate(double const* const* unknowns, double* residuals, double** jacobians) const override {
    const View view = scaled_.view(unknowns[0]);
    if (!view.possible()) return false;
    const Exposure exposure(model_, code_, view, psf_px_);
    const Light light = scaled_.light(unknowns[0]);
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    in_blocks(samples_, [&](const float* x, const float* y, const float* grey, int n) {
      exposure.predict(x, y, n, light, prediction_);
      for (int i = 0; i < n; ++i) {
        const double weight = std::sqrt(weight_of(prediction_.leaked[i])) / noise_;
        *residuals++ = weight * (prediction_.grey[i] - grey[i]);
        if (!jacobian) continue;
        for (int k = 0; k < kUnknowns; ++k)
          *jacobian++ = weight * scaled_.unit(k) * prediction_.gradient[k][i];
      }
    });
    return true;
  }

 private:
  RingModel& model_;
  std::size_t code_;
  const Samples& samples_;
  const Scaled& scaled_;
  double psf_px_, noise_;
  mutable Prediction prediction_;  // reused; one thread evaluates
};

/// What unknowns usually are: about nought.
class Usual final : public ceres::SizedCostFunction<5, kUnknowns> {
 public:
  Usual(const Scaled& scaled, double radius) {
    const std::array<double, 5> deviation{kUsualPerspective / radius, kUsualPerspective / radius,
                                          kUsualBlur * radius, kUsualBlur * radius, kUsualLeak};
    for (std::size_t i = 0; i < kOf.size(); ++i) weight_[i] = scaled.unit(kOf[i]) / deviation[i];
  }

  bool Evaluate(double const* const* unknowns, double* residuals, double** jacobians) const override {
    if (jacobians && jacobians[0]) std::fill_n(jacobians[0], kOf.size() * kUnknowns, 0.0);
    for (std::size_t i = 0; i < kOf.size(); ++i) {
      residuals[i] = weight_[i] * unknowns[0][kOf[i]];
      if (jacobians && jacobians[0])
        jacobians[0][i * kUnknowns + static_cast<std::size_t>(kOf[i])] = weight_[i];
    }
    return true;
  }

 private:
  static constexpr std::array<int, 5> kOf{kVanishingX, kVanishingY, kBlurX, kBlurY, kLeak};
  std::array<double, 5> weight_{};
};

using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

std::optional<Matrix> covariance_at(ceres::Problem& problem, const double* unknowns, const Scaled& scaled) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.min_reciprocal_condition_number = 1e-24;
  ceres::Covariance covariance(options);
  const std::vector<std::pair<const double*, const double*>> all{{unknowns, unknowns}};
  if (!covariance.Compute(all, &problem)) return {};
  Eigen::Matrix<double, kUnknowns, kUnknowns, Eigen::RowMajor> matrix;
  covariance.GetCovarianceBlock(unknowns, unknowns, matrix.data());
  for (int i = 0; i < kUnknowns; ++i)
    for (int k = 0; k < kUnknowns; ++k) matrix(i, k) *= scaled.unit(i) * scaled.unit(k);
  return Matrix(matrix);
}

/// Weighted, of what is left at the end: 1 where the noise was right.
double scatter(const ceres::Solver::Summary& summary, std::size_t pixels) {
  return 2 * summary.final_cost / std::max(1.0, static_cast<double>(pixels) - kUnknowns);
}

}  // namespace

std::optional<Refined> refine(const cv::Mat& gray, RingModel& model, std::size_t code, const Fit& fit,
                              double psf_px) {
  Samples samples;
  spread_samples(gray, model, fit.view, kEveryPixel, samples);
  if (samples.size() < 2 * kUnknowns) return {};
  const double noise = std::max(fit.residual, 0.5);
  const Scaled scaled(fit.view.radius());
  Unknowns unknowns = scaled.of(fit.view, fit.light);
  ceres::Problem problem;
  problem.AddResidualBlock(new EveryPixel(model, code, samples, scaled, psf_px, noise), nullptr,
                           unknowns.data());
  problem.AddResidualBlock(new Usual(scaled, fit.view.radius()), nullptr, unknowns.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMostSteps;
  options.function_tolerance = 1e-8;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return {};
  const auto covariance = covariance_at(problem, unknowns.data(), scaled);
  if (!covariance || !covariance->allFinite()) return {};
  Refined refined{fit, *covariance * scatter(summary, samples.size())};
  refined.fit.view = scaled.view(unknowns.data());
  refined.fit.light = scaled.light(unknowns.data());
  refined.fit.pixels = static_cast<int>(samples.size());
  return refined;
}

}  // namespace relock::ring
