#include "detectors/ring/reading.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relock::ring {
namespace {

constexpr int kCoarsePixels = 260, kFinePixels = 700, kLightPixels = 300;
/// Misfit beyond which a second reading is no use.
constexpr double kHopelessMisfit = 0.6;
constexpr double kSmallRadius_px = 32;
constexpr std::array<double, 6> kSharpnesses_px{0.3, 0.42, 0.58, 0.8, 1.1, 1.5};

/// A picture and how much larger its pixels are.
struct Level {
  const cv::Mat& gray;
  int scale;
};
Level fine_level(const Pyramid& pyramid, const View& view) {
  // Half the resolution loses nothing of a marker that is large and blurred, and its pixels have half the noise.
  const bool half = view.radius() > 36 && view.blur.norm() > 4;
  return half ? Level{pyramid.half(), 2} : Level{pyramid.full(), 1};
}

struct Bits {
  std::size_t code = 0;
  double doubt = 0;
};
Bits bits_of(const Fitter::RingLights& lights) {
  Bits bits;
  const std::size_t last = lights.ring.size() - 1;
  for (std::size_t slot = 0; slot <= last; ++slot) {
    const double light = lights.ring[slot].light;
    if (slot == 0 || slot == last) {
      bits.doubt = std::max(bits.doubt, std::abs(light - 1));
      continue;
    }
    bits.doubt = std::max(bits.doubt, std::min(std::abs(light), std::abs(light - 1)));
    if (light > 0.5) bits.code |= std::size_t{1} << (slot - 1);
  }
  return bits;
}

/// Whether all gaps between rings are black, as far as their light can be told.
bool black_between(const Fitter::RingLights& lights, double most) {
  return std::all_of(lights.gap.begin(), lights.gap.end(), [&](const Fitter::AnnulusLight& gap) {
    return std::abs(gap.light) < most + 3 * gap.error;
  });
}

/// Fits with each of some sharpnesses and keeps the best. Of large markers the sharpness does not move anything
/// else, so that a step will do for a look at each.
std::optional<Fit> with_best_sharpness(const Level& level, Fitter& fitter, std::size_t code, const Fit& fit,
                                       double& psf_px) {
  const bool small = fit.view.radius() * level.scale < kSmallRadius_px;
  std::optional<Fit> best;
  double best_psf = psf_px;
  for (const double psf : kSharpnesses_px) {
    const auto tried =
        fitter.fit(level.gray, code, fit.view,
                   {.pixels = kLightPixels, .steps = small ? 5 : 1, .psf_px = psf, .settled = 0.01});
    if (tried && (!best || tried->residual < best->residual)) best = tried, best_psf = psf;
  }
  psf_px = best_psf;
  return best;
}

bool possible_light(const Fitter::RingLights& lights, const Acceptance& acceptance) {
  return lights.gain >= acceptance.least_gain && lights.offset >= acceptance.least_black &&
         lights.gain + lights.offset <= acceptance.most_white;
}

/// Which part of a marker the fit rests on: the rest is beyond the picture's border, or sees mostly what is around.
double seen_part(const Fit& fit) {
  const double area = M_PI * fit.view.radius() * fit.view.radius();
  return std::min(1.0, fit.pixels / std::min<double>(kFinePixels, area));
}

/// Whether view and code explain the picture. The less of a marker is seen, the better: a few bent edges are soon explained.
bool explained(const Fit& fit, double doubt, double psf_px, const Acceptance& acceptance) {
  const double seen = seen_part(fit), blur = fit.view.blur.norm() / fit.view.radius();
  const double unsharp = psf_px < kSharpnesses_px.back() ? 1 : acceptance.unsharp;
  const double misfit = fit.misfit / (seen * unsharp * acceptance.most_misfit);
  const double structure =
      fit.structure / (seen * (acceptance.most_structure + blur * acceptance.structure_per_blur));
  const double doubtful = doubt / acceptance.most_doubt;
  return std::max({misfit, structure, doubtful}) <= 1 &&
         misfit + structure + doubtful <= 3 * acceptance.most_together;
}

Fit in_full_picture(Fit fit, int scale) {
  fit.view = in_smaller_pixels(fit.view, scale);
  return fit;
}

}  // namespace

std::optional<Reading> read(const Pyramid& pyramid, Fitter& fitter, const Fit& coarse,
                            const Acceptance& acceptance) {
  const Level level = fine_level(pyramid, coarse.view);
  double psf = 0.5;
  Fit fit = coarse;
  fit.view = in_larger_pixels(coarse.view, level.scale);
  const FitOptions light{.pixels = kLightPixels, .psf_px = psf};
  auto lights = fitter.ring_lights(level.gray, fit, light);
  if (!lights) return {};
  Bits bits = bits_of(*lights);
  for (int round = 0; round < 3; ++round) {
    const bool first = round == 0;
    auto fitted = fitter.fit(level.gray, bits.code, fit.view,
                             {.pixels = first ? kCoarsePixels : kFinePixels,
                              .steps = first ? 6 : 9,
                              .psf_px = psf,
                              .settled = first ? 0.02 : 0.006});
    if (!fitted || fitted->misfit > kHopelessMisfit) return {};
    fit = *fitted;
    if (first) {
      fitted = with_best_sharpness(level, fitter, bits.code, fit, psf);
      if (!fitted) return {};
      fit = *fitted;
    }
    lights = fitter.ring_lights(level.gray, fit, {.pixels = kLightPixels, .psf_px = psf});
    if (!lights) return {};
    const Bits now = bits_of(*lights);
    const bool agreed = !first && now.code == bits.code;
    bits = now;
    if (!agreed) continue;
    if (!possible_light(*lights, acceptance) || !explained(fit, bits.doubt, psf, acceptance)) return {};
    if (!black_between(*lights, acceptance.most_light_between)) return {};
    return Reading{in_full_picture(fit, level.scale), bits.code, psf * level.scale, bits.doubt, lights->ring};
  }
  return {};
}

}  // namespace relock::ring
