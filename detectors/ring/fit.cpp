#include "detectors/ring/fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace relock::ring {
namespace {

/// Samples lie within this radius: the outermost edge and some black beyond it.
constexpr double kReach = 1.12;
constexpr std::size_t kFewest = 40;
/// How strongly a priori a marker is seen without perspective: 1 / (grey level / (v R))^2.
constexpr double kPerspectivePrior = 1000;
/// Likewise no leak, 1 / (grey level / grey level)^2.
constexpr double kLeakPrior = 1;

/// Whether the window of the exposure of what is at q stays on the sheet, or nearly so where the movement is long.
double farthest_allowed(const RingModel& model, double movement) {
  const double sheet = model.geometry().quiet_zone - 0.08;
  return std::max(sheet, sheet - 0.05 + 0.42 * movement);
}

/// A step that may be taken at once: by a fifth of the radius, a third of the size, half a radius of blur.
template <class Step>
double bounded(const Step& step, double radius) {
  double part = 1;
  const auto bound = [&](double is, double most) {
    if (is > most) part = std::min(part, most / is);
  };
  bound(std::hypot(step[kCentreX], step[kCentreY]), 0.2 * radius);
  bound(std::hypot(step[kBlurX], step[kBlurY]), 0.5 * radius);
  bound(std::max({std::abs(step[kXX]), std::abs(step[kXY]), std::abs(step[kYY])}) * radius, 0.35);
  return part;
}

template <class Step>
void take(const Step& step, View& view, Light& light) {
  view.centre += Eigen::Vector2d(step[kCentreX], step[kCentreY]);
  view.xx += step[kXX], view.xy += step[kXY], view.yy += step[kYY];
  view.blur += Eigen::Vector2d(step[kBlurX], step[kBlurY]);
  view.vanishing += Eigen::Vector2d(step[kVanishingX], step[kVanishingY]);
  light.gain += step[kGain], light.offset += step[kOffset], light.leak += step[kLeak];
}

}  // namespace

void spread_samples(const cv::Mat& gray, const RingModel& model, const View& view, int count,
                    Samples& samples) {
  samples.clear();
  const Eigen::Matrix2d spread = view.shape().inverse();
  const double width = kReach * spread.row(0).norm(), height = kReach * spread.row(1).norm();
  const double area = M_PI * kReach * kReach * spread.determinant();
  const double step = std::max(1.0, std::sqrt(area / count));
  // Rows are shifted against each other, so that no ring falls between them.
  const double shift = step > 1.01 ? 0.38 : 0;
  const double allowed = farthest_allowed(model, (view.shape() * view.blur).norm());
  // A marker may be larger than the picture, but only what is in the picture takes time.
  const double top = view.centre.y() - height, bottom = std::min(view.centre.y() + height, gray.rows - 0.5);
  for (int row = std::max(0, static_cast<int>((-0.5 - top) / step));; ++row) {
    const double y = top + row * step;
    if (y > bottom) break;
    const int iy = static_cast<int>(std::lround(y));
    if (iy < 0 || iy >= gray.rows) continue;
    const std::uint8_t* pixels = gray.ptr<std::uint8_t>(iy);
    const double begin = view.centre.x() - width + std::fmod(row * shift * step, step);
    const double right = std::min(view.centre.x() + width, gray.cols - 0.5);
    for (double x = begin + step * std::max(0.0, std::floor((-0.5 - begin) / step)); x <= right; x += step) {
      const int ix = static_cast<int>(std::lround(x));
      if (ix < 0 || ix >= gray.cols) continue;
      const Placed at = placed(view, Eigen::Vector2d(ix, iy));
      if (at.depth < 0.3 || at.q.squaredNorm() > kReach * kReach) continue;
      const Eigen::Vector2d half = 0.5 * at.moved_by * view.blur;
      if (std::max((at.q + half).squaredNorm(), (at.q - half).squaredNorm()) > allowed * allowed) continue;
      samples.x.push_back(static_cast<float>(ix)), samples.y.push_back(static_cast<float>(iy));
      samples.grey.push_back(static_cast<float>(pixels[ix]));
    }
  }
}

Light Fitter::light_of(std::size_t code, const View& view, double psf_px) const {
  const Exposure exposure(model_, code, view, psf_px);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  in_blocks(samples_, [&](const float* x, const float* y, const float* grey, int n) {
    Row light, leaked;
    exposure.rings(x, y, n, light);
    exposure.leaked(x, y, n, leaked);
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d row(1, light[i], leaked[i]);
      const double weight = weight_of(leaked[i]);
      normal += weight * row * row.transpose(), right += weight * grey[i] * row;
    }
  });
  normal.diagonal() += Eigen::Vector3d(1e-6, 1e-6, kLeakPrior);
  const Eigen::Vector3d light = normal.ldlt().solve(right);
  return {light[0], light[1], light[2]};
}

std::optional<Light> Fitter::light_in(const cv::Mat& gray, std::size_t code, const View& view,
                                      const FitOptions& options) {
  spread_samples(gray, model_, view, options.pixels, samples_);
  if (samples_.size() < kFewest) return {};
  return light_of(code, view, options.psf_px);
}

Fitter::Equations Fitter::equations(std::size_t code, const View& view, const Light& light,
                                    double psf_px) const {
  const Exposure exposure(model_, code, view, psf_px);
  Equations sums{};
  float before = 0;  // the residual of the sample before: its neighbour, but where a row begins
  Eigen::Matrix<float, kUnknowns, kUnknowns> normal = decltype(normal)::Zero();
  Eigen::Matrix<float, kUnknowns, 1> right = decltype(right)::Zero();
  in_blocks(samples_, [&](const float* x, const float* y, const float* grey, int n) {
    Prediction is;
    exposure.predict(x, y, n, light, is);
    alignas(32) Row weighted[kUnknowns], residual, weight;
    for (int i = 0; i < n; ++i) {
      const float left = grey[i] - is.grey[i], w = weight_of(is.leaked[i]);
      residual[i] = left, weight[i] = w;
      const double wd = w, g = grey[i];
      sums.neighbours += wd * left * before, before = left;
      sums.squares += wd * left * left, sums.weight += wd, sums.grey += wd * g,
          sums.grey_squares += wd * g * g;
    }
    for (int k = 0; k < kUnknowns; ++k)
      for (int i = 0; i < n; ++i) weighted[k][i] = weight[i] * is.gradient[k][i];
    using Rows = Eigen::Matrix<float, kUnknowns, kBlock, Eigen::RowMajor>;
    const Eigen::Map<const Rows, Eigen::Aligned32> plain(is.gradient[0]), times(weighted[0]);
    normal.noalias() += times.leftCols(n) * plain.leftCols(n).transpose();
    right.noalias() += times.leftCols(n) * Eigen::Map<const Eigen::VectorXf>(residual, n);
  });
  sums.normal = normal.cast<double>(), sums.right = right.cast<double>();
  return sums;
}

std::optional<Fit> Fitter::fit(const cv::Mat& gray, std::size_t code, const View& start,
                               const FitOptions& options) {
  View view = start;
  const auto look = [&] {
    spread_samples(gray, model_, view, options.pixels, samples_);
    return samples_.size() >= kFewest;
  };
  if (!look()) return {};
  Light light = light_of(code, view, options.psf_px);
  const double radius = view.radius();
  Equations now = equations(code, view, light, options.psf_px);
  const double perspective_prior = kPerspectivePrior * radius * radius;
  double damping = 1e-2;
  for (int step = 0; step < options.steps; ++step) {
    bool better = false, settled = false;
    for (int attempt = 0; attempt < 3 && !better; ++attempt) {
      Matrix normal = now.normal;
      Vector right = now.right;
      normal.diagonal() *= 1 + damping;
      normal(kLeak, kLeak) += kLeakPrior;
      normal(kBlurX, kBlurX) += 1e-6 * (1 + normal(kCentreX, kCentreX)),
          normal(kBlurY, kBlurY) += 1e-6 * (1 + normal(kCentreY, kCentreY));
      for (const int k : {kVanishingX, kVanishingY}) {
        normal(k, k) += perspective_prior;
        right[k] -= perspective_prior * view.vanishing[k - kVanishingX];
      }
      Vector change = normal.ldlt().solve(right);
      change *= bounded(change, radius);
      View next = view;
      Light lit = light;
      take(change, next, lit);
      Equations then;
      if (change.allFinite() && next.possible() &&
          (then = equations(code, next, lit, options.psf_px)).squares < now.squares) {
        better = true;
        const double gained = (now.squares - then.squares) / now.squares;
        settled = gained < 1e-4 || (next.centre - view.centre).norm() < options.settled * 0.02 * radius;
        view = next, light = lit, now = then;
        damping = std::max(0.2 * damping, 1e-6);
      } else {
        damping = 6 * damping + 1e-4;
      }
    }
    if (!better || settled) break;
    const double spread = now.grey_squares - now.grey * now.grey / now.weight;
    if (step == 2 && now.squares > options.hopeless * options.hopeless * spread) return {};
    if (step == 2 || step == 6) {
      if (!look()) return {};
      now = equations(code, view, light, options.psf_px);
    }
  }
  if (!look()) return {};
  now = equations(code, view, light, options.psf_px);
  const double spread = now.grey_squares - now.grey * now.grey / now.weight;
  if (!(light.gain > 0) || !(spread > 0) || now.weight < 25) return {};
  return Fit{.view = view,
             .light = light,
             .misfit = std::sqrt(now.squares / spread),
             .structure = std::sqrt(std::max(now.neighbours, 0.0) / spread),
             .residual = std::sqrt(now.squares / now.weight),
             .pixels = static_cast<int>(samples_.size())};
}

std::optional<Fitter::RingLights> Fitter::ring_lights(const cv::Mat& gray, const Fit& fit,
                                                      const FitOptions& options) {
  spread_samples(gray, model_, fit.view, options.pixels, samples_);
  std::vector<Exposure> annuli;
  for (std::size_t slot = 0; slot < model_.slots(); ++slot)
    annuli.push_back(Exposure::of_slot(model_, slot, fit.view, options.psf_px));
  for (std::size_t gap = 0; gap < model_.gaps(); ++gap)
    annuli.push_back(Exposure::of_gap(model_, gap, fit.view, options.psf_px));
  // One amplitude for each annulus, black, and what leaks in: linear in all of them.
  const auto count = static_cast<Eigen::Index>(annuli.size()), unknowns = count + 2;
  if (static_cast<Eigen::Index>(samples_.size()) < 2 * unknowns) return {};
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns), row(unknowns);
  double squares = 0, weights = 0;
  in_blocks(samples_, [&](const float* x, const float* y, const float* grey, int n) {
    Row light[2 * (kMostRingBits + 2)], leaked;
    for (std::size_t k = 0; k < annuli.size(); ++k) annuli[k].rings(x, y, n, light[k]);
    annuli.front().leaked(x, y, n, leaked);
    for (int i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k < count; ++k) row[k] = light[k][i];
      row[count] = 1, row[count + 1] = leaked[i];
      const double weight = weight_of(leaked[i]);
      normal.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      right += weight * grey[i] * row;
      squares += weight * grey[i] * grey[i], weights += weight;
    }
  });
  normal.diagonal().head(count).array() += 1e-6 * static_cast<double>(samples_.size());
  normal(count + 1, count + 1) += 1e-3;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal.selfadjointView<Eigen::Lower>());
  const Eigen::VectorXd light = solver.solve(right);
  const Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  const double noise =
      std::max(squares - light.dot(right), 0.0) / std::max(weights - static_cast<double>(unknowns), 1.0);
  RingLights lights;
  const auto slots = static_cast<Eigen::Index>(model_.slots());
  lights.gain = 0.5 * (light[0] + light[slots - 1]), lights.offset = light[count];
  if (!light.allFinite() || !(lights.gain > 0)) return {};
  for (Eigen::Index k = 0; k < count; ++k)
    (k < slots ? lights.ring : lights.gap)
        .push_back(
            {light[k] / lights.gain, std::sqrt(noise * std::max(covariance(k, k), 0.0)) / lights.gain});
  return lights;
}

}  // namespace relock::ring
