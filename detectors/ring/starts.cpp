#include "detectors/ring/starts.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace relock::ring {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Vector2d vector_of(Vec2 v) { return {v.x, v.y}; }
Vec2 point_of(const Vector2d& v) { return {v.x(), v.y()}; }
Vector2d across(const Vector2d& v) { return {-v.y(), v.x()}; }

/// A marker whose blur is too short for a chord to show still has some.
constexpr double kLeastBlur = 0.04;
/// Up to this radius there may be lines in two directions only (finder.cpp).
constexpr double kSmall_px = 22;

/// The best chord of each direction that agrees with the best of all on the code, and nearly on the size.
std::vector<Chord> best_of_directions(const Candidate& candidate) {
  std::map<int, Chord> best;
  for (const Chord& chord : candidate.chords) {
    if (chord.code != candidate.best.code || chord.likeness < std::max(0.85, candidate.best.likeness - 0.1))
      continue;
    if (chord.radius_px > 4 * candidate.best.radius_px || candidate.best.radius_px > 4 * chord.radius_px)
      continue;
    const auto [place, fresh] = best.try_emplace(chord.direction, chord);
    if (!fresh && chord.likeness > place->second.likeness) place->second = chord;
  }
  std::vector<Chord> chords;
  for (const auto& [direction, chord] : best) chords.push_back(chord);
  return chords;
}

/// Chords spread evenly along the blur about the true middle: the mean of those that only differ in that, be they of
/// this candidate or of one farther along.
Vector2d middle_of_similar(const Chord& best, const std::vector<Chord>& chords) {
  const Vector2d along = vector_of(best.along), middle = vector_of(best.middle);
  Vector2d sum = Vector2d::Zero();
  double n = 0;
  for (const Chord& chord : chords) {
    if (chord.direction != best.direction || chord.code != best.code) continue;
    if (std::abs(chord.radius_px - best.radius_px) > 0.1 * best.radius_px) continue;
    const Vector2d off = vector_of(chord.middle) - middle;
    const double reach = std::max(1.0, best.blur) * best.radius_px;
    if (std::abs(off.dot(along)) > 0.12 * best.radius_px + 1 || std::abs(off.dot(across(along))) > reach)
      continue;
    sum += vector_of(chord.middle), ++n;
  }
  return n > 0 ? Vector2d(sum / n) : middle;
}

/// Semi-diameters along a chord and perpendicular to it, `flat` of the first.
View along_and_across(const Vector2d& centre, double radius, const Vector2d& along, double flat) {
  return with_diameters(point_of(centre), radius * along, flat * radius * across(along));
}

/// With sqrt(d' Q d) = 1 for the outline about its middle, Q positive. Nothing if it is not.
std::optional<View> with_form(const Vector2d& middle, const Matrix2d& form) {
  Eigen::SelfAdjointEigenSolver<Matrix2d> solver;
  solver.computeDirect(form);
  if (!(solver.eigenvalues()(0) > 0)) return {};
  const Matrix2d axes = solver.eigenvectors() * solver.eigenvalues().cwiseInverse().cwiseSqrt().asDiagonal();
  return with_diameters(point_of(middle), axes.col(0), axes.col(1));
}

/// A chord that misses the middle by some of the distance between lines still says well where it is along the line. This
/// is the point nearest to what all say.
Vector2d middle_along(const std::vector<Chord>& chords) {
  Matrix2d normal = Matrix2d::Zero();
  Vector2d right = Vector2d::Zero();
  for (const Chord& chord : chords) {
    const Vector2d d = vector_of(chord.along);
    normal += d * d.transpose(), right += d * d.dot(vector_of(chord.middle));
  }
  return normal.ldlt().solve(right);
}

/// Of a small marker lines in two directions tell, along x and along y (finder.cpp). Their radii leave open how much the
/// ellipse leans.
std::vector<View> from_two_radii(const std::vector<Chord>& chords) {
  std::vector<View> all;
  for (const Chord& a : chords)
    for (const Chord& b : chords) {
      if (&b <= &a || std::abs(dot(a.along, b.along)) > 0.1) continue;
      Matrix2d across_and_along;
      across_and_along << vector_of(a.along), vector_of(b.along);
      const Matrix2d back = across_and_along.inverse();
      for (const double lean : {0.0, -0.12, 0.12, -0.3, 0.3}) {
        Matrix2d form;
        form << 1 / (a.radius_px * a.radius_px), lean / (a.radius_px * b.radius_px),
            lean / (a.radius_px * b.radius_px), 1 / (b.radius_px * b.radius_px);
        if (const auto view = with_form(middle_along({a, b}), back.transpose() * form * back))
          all.push_back(*view);
      }
      return all;
    }
  return all;
}

/// The ellipse whose radii along three or more directions are those of the chords: 1/R^2 = d' Q d is linear in Q.
/// Not one where they do not make an ellipse.
std::vector<View> from_radii(const std::vector<Chord>& chords) {
  if (chords.size() < 3) return {};
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Vector2d middle = Vector2d::Zero();
  for (const Chord& chord : chords) {
    const Vector2d d = vector_of(chord.along);
    const Eigen::Vector3d row(d.x() * d.x(), 2 * d.x() * d.y(), d.y() * d.y());
    const double value = 1 / (chord.radius_px * chord.radius_px), weight = 1 / (value * value);
    normal += weight * row * row.transpose(), right += weight * value * row;
    middle += vector_of(chord.middle) / static_cast<double>(chords.size());
  }
  normal.diagonal().array() += 1e-6 * normal.trace();
  const Eigen::Vector3d q = normal.ldlt().solve(right);
  const auto view = with_form(middle, (Matrix2d() << q[0], q[1], q[1], q[2]).finished());
  return view ? std::vector{*view} : std::vector<View>{};
}

/// Tilted markers are nearer on one side: for each view, which way and how much, of what its foreshortening allows.
std::vector<View> with_perspective(const std::vector<View>& views, double focal_px) {
  std::vector<View> all;
  for (const View& view : views) {
    Eigen::SelfAdjointEigenSolver<Matrix2d> solver;
    solver.computeDirect(view.shape());
    const double flat = solver.eigenvalues()(0) / solver.eigenvalues()(1);  // cosine of the tilt
    if (flat > 0.96 || flat < 0.12) continue;
    const Vector2d away = solver.eigenvectors().col(1);  // along the shorter axis
    const double full = std::sqrt(1 / (flat * flat) - 1) / focal_px;
    for (const double part : {-1.2, -0.6, 0.6, 1.2}) {
      View tilted = view;
      tilted.vanishing = part * full * away;
      all.push_back(tilted);
      // What the chords halve is the outline, whose middle is not the image of the marker's middle.
      const Vector2d off = part * full / std::pow(solver.eigenvalues()(1), 2) * away;
      tilted.centre = view.centre + off, all.push_back(tilted);
      tilted.centre = view.centre - off, all.push_back(tilted);
    }
  }
  return all;
}

View blurred(View view, const Vector2d& blur) {
  view.blur = blur;
  return view;
}

/// One chord only, and no blur to be seen: tilted so far that no other line crosses all rings.
std::vector<View> tilted_about(const Chord& chord, double focal_px) {
  std::vector<View> all;
  const Vector2d along = vector_of(chord.along);
  for (const double flat : {0.25, 0.33, 0.42, 0.5, 0.6, 0.7, 0.8, 0.92})
    for (const double turn : {-0.2, 0.0, 0.2}) {
      const Vector2d axis = std::cos(turn) * along + std::sin(turn) * across(along);
      const double radius = chord.radius_px * std::hypot(std::cos(turn), std::sin(turn) / flat);
      View view = along_and_across(vector_of(chord.middle), radius, axis, flat);
      view.blur = kLeastBlur * chord.radius_px * Vector2d(0.9, 0.4);
      for (const double side : {-1.0, 0.0, 1.0}) {
        view.vanishing = side * std::sqrt(1 / (flat * flat) - 1) / focal_px * across(axis);
        all.push_back(view);
      }
    }
  return all;
}

/// A blurred marker shows along lines across its blur. Foreshortened along the blur by any `flat`, blurred by about
/// what the chord's profile says. Where chord and blur are not at right angles, they are conjugate diameters (the
/// marker is tilted) or the chord runs askew.
std::vector<View> blurred_along(const Chord& chord, const Vector2d& direction,
                                const std::vector<Vector2d>& centres) {
  std::vector<View> all;
  const Vector2d along = vector_of(chord.along);
  const double cosine = std::abs(across(direction).dot(along)), sine = std::abs(direction.dot(along));
  if (cosine < 0.35) return {};
  const double blur = std::max(chord.blur, 0.3) * chord.radius_px;
  for (const double flat : {0.6, 0.8, 1.0, 1.25, 1.6})
    for (const double longer : {0.65, 1.0, 1.5})
      for (const Vector2d& centre : centres) {
        const double radius = chord.radius_px * std::hypot(cosine, sine / flat);
        all.push_back(
            blurred(along_and_across(centre, radius, across(direction), flat), longer * blur * direction));
        if (sine < 0.08) continue;
        const View conjugate =
            with_diameters(point_of(centre), chord.radius_px * along, flat * chord.radius_px * direction);
        all.push_back(blurred(conjugate, longer * flat * blur * direction));
      }
  return all;
}

}  // namespace

LocalBlur local_blur(const cv::Mat& gray, const Vector2d& centre, double radius) {
  const int left = std::max(1, static_cast<int>(centre.x() - radius)),
            top = std::max(1, static_cast<int>(centre.y() - radius));
  const int right = std::min(gray.cols - 2, static_cast<int>(centre.x() + radius));
  const int bottom = std::min(gray.rows - 2, static_cast<int>(centre.y() + radius));
  double xx = 0, xy = 0, yy = 0;
  for (int y = top; y <= bottom; ++y) {
    const std::uint8_t *above = gray.ptr<std::uint8_t>(y - 1), *here = gray.ptr<std::uint8_t>(y),
                       *below = gray.ptr<std::uint8_t>(y + 1);
    for (int x = left; x <= right; ++x) {
      const int gx = here[x + 1] - here[x - 1], gy = below[x] - above[x];
      xx += gx * gx, xy += gx * gy, yy += gy * gy;
    }
  }
  const double strongest = 0.5 * std::atan2(2 * xy, xx - yy);
  return {across({std::cos(strongest), std::sin(strongest)}), std::hypot(xx - yy, 2 * xy) / (xx + yy + 1e-6)};
}

std::vector<View> plain_starts(const Candidate& candidate, const std::vector<Chord>& all_chords) {
  const Chord& best = candidate.best;
  const Vector2d along = vector_of(best.along), middle = vector_of(best.middle),
                 similar = middle_of_similar(best, all_chords);
  const std::vector<Chord> chords = best_of_directions(candidate);
  const double least = kLeastBlur * best.radius_px;
  std::vector<View> plain;
  for (View view : from_radii(chords)) {
    view.blur = {least, least / 2};
    plain.push_back(view);
    view.centre = middle;
    if (best.blur > 0.1) view.blur = best.blur * best.radius_px * across(along);
    plain.push_back(view);
  }
  if (best.radius_px < kSmall_px)
    for (View view : from_two_radii(chords)) {
      view.blur = {least, least / 2};
      plain.push_back(view);
    }
  for (const double flat : {1.0, 1.7, 0.6}) {
    const double blur = std::max(best.blur * best.radius_px * std::min(1.0, 1.25 / flat) * flat, least);
    for (const double askew : {0.0, best.misalignment_rad, -best.misalignment_rad}) {
      if (askew != 0 && flat != 1) continue;
      plain.push_back(blurred(along_and_across(similar, best.radius_px, along, flat),
                              blur * (std::cos(askew) * across(along) + std::sin(askew) * along)));
      if (best.misalignment_rad == 0) break;
    }
  }
  return plain;
}

std::vector<View> starts(const Candidate& candidate, const std::vector<Chord>& all_chords,
                         const LocalBlur& local_blur, double focal_px) {
  const Chord& best = candidate.best;
  const std::size_t directions = best_of_directions(candidate).size();
  const std::vector<View> plain = plain_starts(candidate, all_chords);
  std::vector<View> all = plain;
  const auto add = [&](const std::vector<View>& more) { all.insert(all.end(), more.begin(), more.end()); };
  if (best.blur < 0.9 && directions >= 3) add(with_perspective(plain, focal_px));
  if (best.blur < 0.3 && directions < 5 && best.likeness > 0.93) add(tilted_about(best, focal_px));
  if (best.blur > 0.1 || local_blur.coherence > 0.2) {
    const Vector2d middle = vector_of(best.middle), similar = middle_of_similar(best, all_chords);
    const Vector2d along_blur = 0.25 * std::max(best.blur, 0.3) * best.radius_px * local_blur.direction;
    add(blurred_along(best, local_blur.direction,
                      {middle, similar, similar - along_blur, similar + along_blur}));
  }
  return all;
}

}  // namespace relock::ring
