#include "detectors/ring/chord_templates.h"

#include <algorithm>
#include <cmath>

#include "detectors/ring/vector_clones.h"

namespace relock::ring {
namespace {

constexpr std::array<double, 10> kBlurs = {0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.7, 2.0};
constexpr std::array<double, 3> kMisalignments = {0, 0.3, 0.6};
constexpr double kSharp = 0.02, kSoft = 0.05;
constexpr double kBlurThatHidesSoftness = 0.3;

constexpr std::size_t kLanes = 16;         // the templates' number is rounded up to it
constexpr std::size_t kMostShapes = 2048;  // six bits have 1792

constexpr double kProfileEnd = 1.5;
constexpr double kEdgeSpan = 0.03;  // the slope is measured over twice this
constexpr double kLastEdge = 1.10;

/// Share of the movement that a point of the line spends on a disc.
double time_on_disc(double radius, double along_blur, double across_blur, double blur) {
  const double squared = radius * radius - across_blur * across_blur;
  if (squared <= 0) return 0;
  const double half = std::sqrt(squared);
  const double begin = std::max(along_blur - blur / 2, -half), end = std::min(along_blur + blur / 2, half);
  return std::max(0.0, end - begin) / blur;
}

/// The same without movement: the share of one step of the grid that is on the disc.
double share_on_disc(double radius, double rho) {
  return std::clamp((radius - std::abs(rho)) / kGrid + 0.5, 0.0, 1.0);
}

double on_disc(double radius, double rho, const Exposed& exposed) {
  if (exposed.blur < kGrid) return share_on_disc(radius, rho);
  return time_on_disc(radius, rho * std::sin(exposed.misalignment_rad),
                      rho * std::cos(exposed.misalignment_rad), exposed.blur);
}

std::vector<double> gaussian(double sigma) {
  const int reach = static_cast<int>(std::ceil(3 * sigma / kGrid));
  std::vector<double> weights;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std::exp(-0.5 * std::pow(i * kGrid / sigma, 2)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double at(const std::vector<double>& profile, double rho) {
  const double place = std::abs(rho) / kGrid;
  const auto left = static_cast<std::size_t>(place);
  if (left + 1 >= profile.size()) return 0;
  const double part = place - static_cast<double>(left);
  return (1 - part) * profile[left] + part * profile[left + 1];
}

/// From the outermost ring on: other rings have edges, too.
double steepest_outer_edge(const std::vector<double>& profile, double from) {
  double edge = 1, steepest = 0;
  for (double rho = from; rho < kLastEdge; rho += 0.005) {
    const double fall = at(profile, rho - kEdgeSpan) - at(profile, rho + kEdgeSpan);
    if (fall > steepest) steepest = fall, edge = rho;
  }
  return edge;
}

std::vector<Exposed> exposures(double most_blur) {
  std::vector<Exposed> all;
  for (const double blur : kBlurs) {
    if (blur > most_blur) break;
    for (const double misalignment : kMisalignments) {
      if (blur < kBlurThatHidesSoftness && misalignment > 0) continue;
      if (blur < kBlurThatHidesSoftness) all.push_back({blur, misalignment, kSharp});
      all.push_back({blur, misalignment, kSoft});
    }
  }
  return all;
}

/// sums[j] = sum over i of fold[i] columns[i * stride + j]. Four samples in one pass, in this order in every version.
RELOCK_VECTOR_CLONES void correlate(const float* __restrict fold, const float* __restrict columns,
                                    std::size_t stride, float* __restrict sums) {
  for (std::size_t j = 0; j < stride; ++j) sums[j] = 0;
  for (std::size_t i = 0; i < kFoldSamples; i += 4) {
    const float a = fold[i], b = fold[i + 1], c = fold[i + 2], d = fold[i + 3];
    const float *column_a = columns + i * stride, *column_b = column_a + stride,
                *column_c = column_b + stride, *column_d = column_c + stride;
    for (std::size_t j = 0; j < stride; ++j)
      sums[j] += (a * column_a[j] + b * column_b[j]) + (c * column_c[j] + d * column_d[j]);
  }
}

}  // namespace

std::vector<double> exposed_ring(const Annulus& ring, const Exposed& exposed) {
  const std::vector<double> weights = gaussian(exposed.softness);
  const int reach = static_cast<int>(weights.size() / 2);
  const int steps = static_cast<int>(kProfileEnd / kGrid) + 1;
  std::vector<double> exact;  // from -reach to steps + reach
  for (int step = -reach; step < steps + reach; ++step)
    exact.push_back(on_disc(ring.outer, step * kGrid, exposed) - on_disc(ring.inner, step * kGrid, exposed));
  std::vector<double> profile(static_cast<std::size_t>(steps));
  for (std::size_t step = 0; step < profile.size(); ++step)
    for (std::size_t i = 0; i < weights.size(); ++i) profile[step] += weights[i] * exact[step + i];
  return profile;
}

ChordTemplates::ChordTemplates(const RingGeometry& geometry, double most_blur) {
  const std::vector<std::string> codes = all_ring_bits(geometry.bits());
  first_edge_ = geometry.slots.back().inner;
  for (const Exposed& exposed : exposures(most_blur)) {
    std::vector<std::vector<double>> rings;
    for (const Annulus& slot : geometry.slots) rings.push_back(exposed_ring(slot, exposed));
    for (std::size_t code = 0; code < codes.size(); ++code) {
      std::vector<double> profile(rings.front().size());
      for (const Annulus& ring : rings_of({geometry, codes[code]})) {
        const auto slot = std::find(geometry.slots.begin(), geometry.slots.end(), ring);
        const auto& light = rings[static_cast<std::size_t>(slot - geometry.slots.begin())];
        std::transform(profile.begin(), profile.end(), light.begin(), profile.begin(), std::plus<>());
      }
      add(code, exposed, profile);
    }
  }
  lay_out();
}

void ChordTemplates::add(std::size_t code, const Exposed& exposed, const std::vector<double>& profile) {
  const double edge = steepest_outer_edge(profile, first_edge_);
  std::array<double, kFoldSamples> values{};
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < kFoldSamples; ++i) {
    values[i] = at(profile, (static_cast<double>(i) + 0.5) / kFoldSamples * kReach * edge);
    mean += values[i] / kFoldSamples;
  }
  for (double& value : values) {
    value -= mean;
    squares += value * value;
  }
  Fold fold{};
  for (std::size_t i = 0; i < kFoldSamples; ++i)
    fold[i] = static_cast<float>(values[i] / std::sqrt(squares + 1e-12));
  shapes_.push_back({code, exposed, edge});
  folds_.push_back(fold);
}

void ChordTemplates::lay_out() {
  stride_ = (shapes_.size() + kLanes - 1) / kLanes * kLanes;
  columns_.assign(stride_ * kFoldSamples, 0);
  for (std::size_t rank = 0; rank < folds_.size(); ++rank)
    for (std::size_t i = 0; i < kFoldSamples; ++i) columns_[i * stride_ + rank] = folds_[rank][i];
}

Fold ChordTemplates::fold(std::size_t rank) const { return folds_[rank]; }

ChordTemplates::Match ChordTemplates::best(const Fold& fold) const {
  std::array<float, kMostShapes> sums;
  correlate(fold.data(), columns_.data(), stride_, sums.data());
  const auto best = std::max_element(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(size()));
  return {static_cast<std::size_t>(best - sums.begin()), *best};
}

}  // namespace relock::ring
