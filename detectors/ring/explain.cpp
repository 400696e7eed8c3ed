#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/opencv.h"
#include "detectors/ring/detector.h"

// The stages of the detector as pictures and charts, of what look() has left behind.

namespace relock::ring {
namespace {

constexpr int kFractionBits = 4;       // OpenCV draws to parts of a pixel
constexpr std::size_t kMostDrawn = 8;  // candidates and starts: more would hide each other
constexpr int kPanel_px = 200;         // least width of one of the pictures side by side
const cv::Scalar kGreen(0, 200, 0), kGrey(160, 160, 160);

cv::Point drawn_at(Vec2 point) {
  return {cvRound(point.x * (1 << kFractionBits)), cvRound(point.y * (1 << kFractionBits))};
}

cv::Mat3b colours_of(const cv::Mat& gray) {
  cv::Mat3b colours;
  cv::cvtColor(gray, colours, cv::COLOR_GRAY2BGR);
  return colours;
}
/// Half as bright, for what is drawn on it to be seen.
cv::Mat3b dimmed(const cv::Mat& gray) {
  cv::Mat half;
  gray.convertTo(half, CV_8U, 0.5);
  return colours_of(half);
}

/// From blue at `least` over green to red at 1.
cv::Scalar colour_of(double likeness, double least) {
  const double part = std::clamp((likeness - least) / (1 - least), 0.0, 1.0);
  cv::Mat3b one(1, 1, cv::Vec3b(static_cast<std::uint8_t>(120 * (1 - part)), 255, 255));
  cv::cvtColor(one, one, cv::COLOR_HSV2BGR);
  return cv::Scalar(one(0, 0));
}

void draw_outline(cv::Mat3b& picture, const View& view, const cv::Scalar& colour, int width) {
  const Ellipse e = outline_of(view);
  // OpenCV's integers have no room for the outline of a start that sees far beyond the picture.
  if (!well_formed(e) || e.semi_major > 4.0 * (picture.cols + picture.rows)) return;
  const auto px = [](double length) { return static_cast<float>(length); };
  cv::ellipse(picture,
              cv::RotatedRect({px(e.centre.x), px(e.centre.y)}, {px(2 * e.semi_major), px(2 * e.semi_minor)},
                              px(e.angle_rad * 180 / CV_PI)),
              colour, width, cv::LINE_AA);
}

void write(cv::Mat3b& picture, const std::string& text, Vec2 at, const cv::Scalar& colour) {
  cv::putText(picture, text, {cvRound(at.x) + 6, cvRound(at.y) - 6}, cv::FONT_HERSHEY_SIMPLEX, 0.6, colour, 2,
              cv::LINE_AA);
}

std::string counted(std::size_t n, const std::string& thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

Stage candidates_stage(const Look& look) {
  const std::vector<Candidate>& all = *look.candidates;
  cv::Mat3b picture = colours_of(look.gray);
  for (std::size_t rank = std::min(all.size(), kMostDrawn); rank-- > 0;) {
    const bool closely = std::any_of(look.closely.begin(), look.closely.end(),
                                     [&](const Closely& one) { return one.candidate == &all[rank]; });
    const cv::Scalar& colour = closely ? kGreen : kGrey;
    const Chord& best = all[rank].best;
    cv::circle(picture, drawn_at(best.middle), cvRound(best.radius_px * (1 << kFractionBits)), colour, 1,
               cv::LINE_AA, kFractionBits);
    write(picture, std::to_string(rank + 1), best.middle, colour);
  }
  return {"candidates",
          fmt::format("{} that chords agree on, the first {} with their ranks and the radius of their best "
                      "chord; {} looked at closely (green)",
                      counted(all.size(), "place"), std::min(all.size(), kMostDrawn), look.closely.size()),
          picture};
}

Stage starts_stage(const Look& look, const Closely& closely) {
  cv::Mat3b picture = dimmed(look.gray);
  for (std::size_t rank = std::min(closely.starts.size(), kMostDrawn); rank-- > 0;) {
    const auto& [view, likeness] = closely.starts[rank];
    const View full = in_smaller_pixels(view, 1 << closely.level);
    draw_outline(picture, full, colour_of(likeness, 0), 1);
    const Vec2 centre{full.centre.x(), full.centre.y()}, half{full.blur.x() / 2, full.blur.y() / 2};
    cv::line(picture, drawn_at(centre - half), drawn_at(centre + half), colour_of(likeness, 0), 1,
             cv::LINE_AA, kFractionBits);
  }
  return {
      "starts",
      fmt::format("the likeliest {} of the views from which the fit of one candidate may start: outermost "
                  "ring and blur; blue is unlike the picture, red like it, here {:.2f} at most",
                  std::min(closely.starts.size(), kMostDrawn),
                  closely.starts.empty() ? 0 : closely.starts.front().likeness),
      picture};
}

/// What is lit at each radius: 0 where nothing is, the light of a ring where it is.
Stage rings_stage(const Reading& reading, const RingGeometry& geometry, const std::string& bits) {
  Chart chart{"part of the radius", "light, 1: white", {}};
  ChartCurve lights{"light of each ring", {{0, 0}}};
  for (std::size_t slot = 0; slot < reading.lights.size(); ++slot) {
    const auto [inner, outer] = geometry.slots[slot];
    const double light = reading.lights[slot].light;
    lights.points.insert(lights.points.end(), {{inner, 0}, {inner, light}, {outer, light}, {outer, 0}});
  }
  chart.curves = {lights, {"0", {{0, 0}, {1, 0}}}, {"1", {{0, 1}, {1, 1}}}};
  return {
      "rings",
      fmt::format("each ring's own light, fitted at the view found: {}; the farthest from 0 or 1 is off by "
                  "{:.3f}",
                  bits, reading.doubt),
      chart};
}

Stage answer_stage(const Look& look, const std::vector<std::string>& codes) {
  cv::Mat3b picture = colours_of(look.gray);
  for (const Reading& marker : look.markers) {
    const View& view = marker.fit.view;
    const Vec2 centre{view.centre.x(), view.centre.y()}, half{view.blur.x() / 2, view.blur.y() / 2};
    draw_outline(picture, view, kGreen, 2);
    cv::line(picture, drawn_at(centre - half), drawn_at(centre + half), kGreen, 1, cv::LINE_AA,
             kFractionBits);
    cv::drawMarker(picture, {cvRound(centre.x), cvRound(centre.y)}, kGreen, cv::MARKER_CROSS, 9);
    write(picture, codes[marker.code], centre, kGreen);
  }
  return {"answer", counted(look.markers.size(), "sighting"), picture};
}

/// The one that is explained: of those that came farthest the one that leaves the least unexplained.
const Closely* most_telling(const Look& look) {
  const auto misfit = [](const Closely& c) {
    return c.read ? c.read->fit.misfit : c.coarse ? 1 + c.coarse->misfit : 3;
  };
  const auto best =
      std::min_element(look.closely.begin(), look.closely.end(),
                       [&](const Closely& a, const Closely& b) { return misfit(a) < misfit(b); });
  return best == look.closely.end() ? nullptr : &*best;
}

/// The part of the picture that a marker and its quiet zone have passed through.
cv::Rect part_around(const View& view, const cv::Mat& gray) {
  const Ellipse e = outline_of(view);
  const double reach = 1.25 * e.semi_major + view.blur.norm() / 2;
  const double least = std::max(gray.cols, gray.rows);
  const auto at = [&](double place) { return cvRound(std::clamp(place, -least, 2 * least)); };
  const cv::Point from(at(e.centre.x - reach), at(e.centre.y - reach));
  const cv::Point to(at(e.centre.x + reach), at(e.centre.y + reach));
  return cv::Rect(from, to) & cv::Rect({}, gray.size());
}

cv::Mat1f predicted_part(const Exposure& exposure, const Light& light, const cv::Rect& part) {
  cv::Mat1f grey(part.size());
  Row x, y;
  Prediction is;
  for (int row = 0; row < part.height; ++row)
    for (int from = 0; from < part.width; from += kBlock) {
      const int n = std::min(kBlock, part.width - from);
      for (int i = 0; i < n; ++i)
        x[i] = static_cast<float>(part.x + from + i), y[i] = static_cast<float>(part.y + row);
      exposure.predict(x, y, n, light, is);
      std::copy_n(is.grey, n, grey[row] + from);
    }
  return grey;
}

}  // namespace

Stage RingDetector::chords_stage() const {
  const std::vector<Chord>& chords = finder_.chords();
  cv::Mat3b picture = dimmed(look_.gray);
  std::vector<const Chord*> likest_last;
  for (const Chord& chord : chords) likest_last.push_back(&chord);
  std::stable_sort(likest_last.begin(), likest_last.end(),
                   [](const Chord* a, const Chord* b) { return a->likeness < b->likeness; });
  for (const Chord* chord : likest_last) {
    const Vec2 half = chord->radius_px * chord->along;
    cv::line(picture, drawn_at(chord->middle - half), drawn_at(chord->middle + half),
             colour_of(chord->likeness, 0.8), 1, cv::LINE_AA, kFractionBits);
  }
  return {"chords",
          fmt::format("{} across the outermost ring, along lines in {} directions; their likeness to a line "
                      "through a marker, from 0.8 (blue) to 1 (red)",
                      counted(chords.size(), "chord"), kLineDirections.size()),
          picture};
}

Stage RingDetector::fit_stage(const Closely& closely) {
  const bool read = closely.read.has_value();
  const Fit& fit = read ? closely.read->fit : *closely.coarse;
  const std::size_t code = read ? closely.read->code : closely.candidate->best.code;
  const int scale = 1 << closely.level;
  const double psf_px =
      read ? closely.read->psf_px : coarse_psf_px(in_larger_pixels(fit.view, scale)) * scale;
  const cv::Rect part = part_around(fit.view, look_.gray);
  const bool in_its_light = read && closely.read->in_light;
  const cv::Mat seen = (in_its_light ? in_light().full() : look_.gray)(part);
  const cv::Mat1f predicted = predicted_part(Exposure(model_, code, fit.view, psf_px), fit.light, part);
  cv::Mat1f residual;
  seen.convertTo(residual, CV_32F);
  residual = 4 * (residual - predicted) + 128;
  cv::Mat1b panels[3];
  const int times = std::max(1, kPanel_px / std::max(1, part.width));
  const cv::Mat shown[] = {seen, predicted, residual};
  for (int i = 0; i < 3; ++i) {
    shown[i].convertTo(panels[i], CV_8U);
    cv::resize(panels[i], panels[i], {}, times, times, cv::INTER_NEAREST);
  }
  cv::Mat1b side_by_side;
  cv::hconcat(panels, 3, side_by_side);
  return {
      "fit",
      fmt::format("seen{}, predicted by the {} fit, and four times their difference about grey; it leaves "
                  "{:.2f} unexplained, radius {:.1f} px, blur {:.1f} px",
                  in_its_light ? " in light" : "", read ? "last" : "coarse", fit.misfit, fit.view.radius(),
                  fit.view.blur.norm()),
      side_by_side};
}

std::vector<Stage> RingDetector::explain(const Image& image, const std::optional<Box>& where) {
  if (!look_at_part(image, where))
    return {{"answer", "no sightings: the hint lies outside of the picture", cv::Mat()}};
  std::vector<Stage> stages;
  if (look_.candidates) {
    stages.push_back(chords_stage());
    stages.push_back(candidates_stage(look_));
  }
  if (const Closely* closely = most_telling(look_)) {
    stages.push_back(starts_stage(look_, *closely));
    if (closely->coarse) stages.push_back(fit_stage(*closely));
    if (closely->read)
      stages.push_back(rings_stage(*closely->read, model_.geometry(), codes_[closely->read->code]));
  }
  stages.push_back(answer_stage(look_, codes_));
  return stages;
}

}  // namespace relock::ring
