#include "detectors/ring/coarse_fit.h"

#include <algorithm>
#include <cmath>

#include "detectors/ring/likeness.h"

namespace relock::ring {
namespace {

// A start that is less like the picture is not worth a fit; nor is one that is so much less so than the best.
constexpr double kLeastLikeness = 0.4, kWorse = 0.15;
/// All starts are compared with the picture on one point of so many, and so many of them then on all points.
constexpr std::size_t kRoughly = 2, kLikely = 28;
constexpr std::size_t kMostStarts = 4;
/// So many are tried where one has come near to a marker: clutter rarely does.
constexpr std::size_t kMostStartsNear = 16;
/// A coarse fit that is good enough to try no other start, one that is none, and one from
/// whose neighbour a marker might be reached.
constexpr double kGoodMisfit = 0.25, kMostMisfit = 0.55, kNearMisfit = 0.6;
// px of the level: a smaller marker shows no rings, and a larger one would have been found on a coarser level.
constexpr double kLeastRadius_px = 2, kMostRadius_px = 400;
constexpr double kSmall_px = 13;
/// Radii between the middles of chords of one marker; others may be of something else.
constexpr double kOneMiddle = 0.12;
constexpr double kSoft_px = 0.6;
/// What most cameras have, in widths of the picture; only how strong a perspective is tried depends on it.
constexpr double kFocalWidths = 0.9;

/// Whether a fit from one would come to the same as a fit from the other.
bool alike(const View& a, const View& b) {
  const double r = b.radius();
  const double blur_apart = std::min((a.blur - b.blur).norm(), (a.blur + b.blur).norm());
  return (a.centre - b.centre).norm() < 0.08 * r && std::abs(a.xx - b.xx) * r < 0.12 &&
         std::abs(a.xy - b.xy) * r < 0.12 && std::abs(a.yy - b.yy) * r < 0.12 &&
         (a.vanishing - b.vanishing).norm() * r < 0.03 && blur_apart < 0.2 * r;
}

/// px of the level. Without those that are no marker, or too small or large for the level.
std::vector<ScoredView> scored(const std::vector<View>& starts, const Candidate& candidate,
                               const Pyramid& pyramid, std::size_t level, RingModel& model,
                               std::size_t one_point_of) {
  std::vector<ScoredView> all;
  for (const View& start : starts) {
    const View view = in_larger_pixels(start, 1 << level);
    if (!view.possible() || view.radius() < kLeastRadius_px || view.radius() > kMostRadius_px) continue;
    all.push_back({view, likeness(pyramid.level[level], model, candidate.best.code, view, coarse_psf_px(view),
                                  one_point_of)});
  }
  return all;
}

void sort_likeliest_first(std::vector<ScoredView>& views) {
  std::stable_sort(views.begin(), views.end(),
                   [](const ScoredView& a, const ScoredView& b) { return a.likeness > b.likeness; });
}

}  // namespace

double coarse_psf_px(const View& view) { return view.radius() < kSmall_px ? 0.45 : kSoft_px; }

std::size_t first_level(const Candidate& candidate) {
  const Chord& best = candidate.best;
  double least = best.radius_px;
  for (const Chord& chord : candidate.chords)
    if (chord.code == best.code && chord.likeness > best.likeness - 0.06 &&
        chord.radius_px > 0.2 * best.radius_px &&
        norm(chord.middle - best.middle) < kOneMiddle * best.radius_px + 2)
      least = std::min(least, chord.radius_px);
  // Blurred, a chord shorter than half of the longest is of something else.
  if (best.blur > 0.5) least = std::max(least, 0.5 * best.radius_px);
  return least > 44 ? 2 : least > 20 ? 1 : 0;
}

double glance(const Candidate& candidate, const std::vector<Chord>& chords, const Pyramid& pyramid,
              RingModel& model) {
  const std::size_t level = first_level(candidate);
  double likest = -1;
  for (const ScoredView& start :
       scored(plain_starts(candidate, chords), candidate, pyramid, level, model, kRoughly))
    likest = std::max(likest, start.likeness);
  return likest;
}

std::vector<ScoredView> scored_starts(const Candidate& candidate, const std::vector<Chord>& chords,
                                      const Pyramid& pyramid, std::size_t level, RingModel& model) {
  const int scale = 1 << level;
  const cv::Mat& gray = pyramid.level[level];
  const View here = in_larger_pixels(straight_on(candidate.best.middle, candidate.best.radius_px), scale);
  const LocalBlur blur = local_blur(gray, here.centre, 0.95 * here.radius());
  auto all = scored(starts(candidate, chords, blur, kFocalWidths * pyramid.full().cols), candidate, pyramid,
                    level, model, kRoughly);
  sort_likeliest_first(all);
  if (all.size() > kLikely) all.resize(kLikely);
  for (ScoredView& start : all)
    start.likeness = likeness(gray, model, candidate.best.code, start.view, coarse_psf_px(start.view));
  sort_likeliest_first(all);
  return all;
}

std::optional<Fit> fit_from_best(const std::vector<ScoredView>& starts, std::size_t code,
                                 const Pyramid& pyramid, std::size_t level, Fitter& fitter) {
  std::vector<const View*> tried;
  std::optional<Fit> best;
  for (const auto& [view, likeness] : starts) {
    const bool near = best && best->misfit < kNearMisfit;
    if (tried.size() >= (near ? kMostStartsNear : kMostStarts) || likeness < kLeastLikeness ||
        likeness < starts.front().likeness - kWorse)
      break;
    if (std::any_of(tried.begin(), tried.end(),
                    [&, &v = view](const View* other) { return alike(*other, v); }))
      continue;
    tried.push_back(&view);
    const FitOptions coarse{
        .pixels = 130, .steps = 6, .psf_px = coarse_psf_px(view), .settled = 0.1, .hopeless = 0.82};
    const auto fit = fitter.fit(pyramid.level[level], code, view, coarse);
    if (fit && (!best || fit->misfit < best->misfit)) best = fit;
    if (best && best->misfit < kGoodMisfit) break;
  }
  if (!best || best->misfit > kMostMisfit) return {};
  best->view = in_smaller_pixels(best->view, 1 << level);
  return best;
}

}  // namespace relock::ring
