#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/frame.h"
#include "core/plugin_abi.h"
#include "core/sighting.h"
#include "core/stage.h"

// Between relock's types and those of core/plugin_abi.h, both ways side by side: one side of a plug-in uses the
// one, the other side the other.

namespace relock::plugin {

inline relock_box to_c(const Box& box) { return {box.x, box.y, box.width, box.height}; }
inline Box from_c(const relock_box& box) { return {box.x, box.y, box.width, box.height}; }

inline relock_image to_c(const Image& image) {
  if (image.empty()) return {};
  const std::uint32_t format = image.format() == PixelFormat::gray8 ? RELOCK_GRAY8 : RELOCK_BGR8;
  return {image.row(0), image.stride(), image.size().width, image.size().height, format, 0};
}
/// Throws Error on a format that it does not know.
inline Image from_c(const relock_image& image) {
  if (image.data == nullptr) return {};
  if (image.format != RELOCK_GRAY8 && image.format != RELOCK_BGR8)
    throw Error("a picture has pixels of format " + std::to_string(image.format) +
                ", which this plug-in is too old to know");
  const auto format = image.format == RELOCK_GRAY8 ? PixelFormat::gray8 : PixelFormat::bgr8;
  return Image(image.data, Size{image.width, image.height}, format, image.stride);
}

inline relock_frame to_c(const Frame& frame) {
  return {sizeof(relock_frame), frame.index, ns(frame.captured), to_c(frame.image)};
}
inline Frame from_c(const relock_frame& frame) {
  return {frame.index, time_ns(frame.captured_ns), from_c(frame.image)};
}

inline void outline_to_c(const Outline& outline, relock_sighting& seen) {
  double* out = seen.outline;
  if (const auto* box = std::get_if<Box>(&outline)) {
    seen.outline_kind = RELOCK_OUTLINE_BOX;
    out[0] = box->x, out[1] = box->y, out[2] = box->width, out[3] = box->height;
  } else if (const auto* quad = std::get_if<Quad>(&outline)) {
    seen.outline_kind = RELOCK_OUTLINE_QUAD;
    for (const Vec2& corner : quad->corner) *out++ = corner.x, *out++ = corner.y;
  } else {
    const auto& e = std::get<Ellipse>(outline);
    seen.outline_kind = RELOCK_OUTLINE_ELLIPSE;
    out[0] = e.centre.x, out[1] = e.centre.y, out[2] = e.semi_major, out[3] = e.semi_minor;
    out[4] = e.angle_rad;
  }
}
inline Outline outline_from_c(const relock_sighting& seen) {
  const double* in = seen.outline;
  switch (seen.outline_kind) {
    case RELOCK_OUTLINE_BOX:
      return Box{in[0], in[1], in[2], in[3]};
    case RELOCK_OUTLINE_QUAD:
      return Quad{{Vec2{in[0], in[1]}, Vec2{in[2], in[3]}, Vec2{in[4], in[5]}, Vec2{in[6], in[7]}}};
    case RELOCK_OUTLINE_ELLIPSE:
      return Ellipse{{in[0], in[1]}, in[2], in[3], in[4]};
    default:
      throw Error("it answers with an outline of kind " + std::to_string(seen.outline_kind) +
                  ", which is none");
  }
}

/// Points into `sighting`, which must outlive it. `Sighting::track` stays behind: relock sets it.
inline relock_sighting to_c(const Sighting& sighting) {
  relock_sighting seen{};
  seen.size = sizeof(relock_sighting);
  seen.centre_x = sighting.centre.x, seen.centre_y = sighting.centre.y;
  seen.centre_kind =
      sighting.centre_kind == CentreKind::outline ? RELOCK_CENTRE_OUTLINE : RELOCK_CENTRE_PROJECTED;
  outline_to_c(sighting.outline, seen);
  if (sighting.code) {
    seen.code_family = sighting.code->family.c_str();
    seen.code_value = sighting.code->value.c_str();
  }
  seen.confidence = sighting.confidence;
  seen.blur_direction_rad = sighting.blur ? sighting.blur->direction_rad : 0;
  seen.blur_length_px = sighting.blur ? sighting.blur->length_px : -1;
  return seen;
}
/// Throws Error when it is none. Whether its numbers make sense is judged elsewhere.
inline Sighting from_c(const relock_sighting& seen) {
  if (seen.size < sizeof(relock_sighting))
    throw Error("it answers with a sighting of " + std::to_string(seen.size) + " bytes, not " +
                std::to_string(sizeof(relock_sighting)));
  if (seen.centre_kind != RELOCK_CENTRE_OUTLINE && seen.centre_kind != RELOCK_CENTRE_PROJECTED)
    throw Error("it answers with a centre of kind " + std::to_string(seen.centre_kind) + ", which is none");
  Sighting sighting = sighting_of(outline_from_c(seen));
  sighting.centre = {seen.centre_x, seen.centre_y};
  if (seen.centre_kind == RELOCK_CENTRE_PROJECTED) sighting.centre_kind = CentreKind::projected;
  if ((seen.code_family == nullptr) != (seen.code_value == nullptr))
    throw Error("it answers with half a code: a family without a value, or a value without a family");
  if (seen.code_family != nullptr) sighting.code = Code{seen.code_family, seen.code_value};
  sighting.confidence = seen.confidence;
  if (seen.blur_length_px >= 0) sighting.blur = BlurEstimate{seen.blur_direction_rad, seen.blur_length_px};
  return sighting;
}

/// A stage for the other side. It points into itself and into the stage that it was made of.
struct StageForC {
  std::vector<std::vector<double>> points;  // of each curve
  std::vector<relock_curve> curves;
  relock_stage stage{};
};
inline StageForC to_c(const Stage& stage) {
  StageForC made;
  made.stage.size = sizeof(relock_stage);
  made.stage.name = stage.name.c_str(), made.stage.sentence = stage.sentence.c_str();
  if (const auto* picture = std::get_if<Picture>(&stage.shown)) {
    made.stage.picture = to_c(picture->view());
    return made;
  }
  const auto& chart = std::get<Chart>(stage.shown);
  made.stage.x = chart.x.c_str(), made.stage.y = chart.y.c_str();
  for (const ChartCurve& curve : chart.curves) {
    std::vector<double>& flat = made.points.emplace_back();
    for (const Vec2& point : curve.points) flat.insert(flat.end(), {point.x, point.y});
    made.curves.push_back({curve.name.c_str(), flat.data(), curve.points.size()});
  }
  made.stage.curves = made.curves.data(), made.stage.curve_count = made.curves.size();
  return made;
}

inline std::string stage_text(const char* text, const char* what) {
  if (text == nullptr) throw Error(std::string("it shows a stage whose ") + what + " is NULL");
  return text;
}
inline Picture picture_from_c(const relock_image& image) {
  const std::uint64_t row =
      static_cast<std::uint64_t>(std::max(image.width, 0)) * (image.format == RELOCK_BGR8 ? 3 : 1);
  if ((image.format != RELOCK_GRAY8 && image.format != RELOCK_BGR8) || row == 0 || image.height <= 0 ||
      image.stride < row)
    throw Error("it shows a stage whose picture is none: " + std::to_string(image.width) + " x " +
                std::to_string(image.height) + " px of format " + std::to_string(image.format) + ", " +
                std::to_string(image.stride) + " bytes a row");
  return Picture(from_c(image));
}
inline Chart chart_from_c(const relock_stage& shown) {
  Chart chart{stage_text(shown.x, "x"), stage_text(shown.y, "y"), {}};
  if (shown.curve_count > 0 && shown.curves == nullptr) throw Error("it shows a stage whose curves are NULL");
  for (std::uint64_t i = 0; i < shown.curve_count; ++i) {
    const relock_curve& from = shown.curves[i];
    ChartCurve curve{stage_text(from.name, "curve's name"), {}};
    if (from.count > 0 && from.points == nullptr) throw Error("it shows a stage whose points are NULL");
    for (std::uint64_t k = 0; k < from.count; ++k)
      curve.points.push_back({from.points[2 * k], from.points[2 * k + 1]});
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}
/// A copy. Throws Error when it is none.
inline Stage from_c(const relock_stage& shown) {
  if (shown.size < sizeof(relock_stage))
    throw Error("it shows a stage of " + std::to_string(shown.size) + " bytes, not " +
                std::to_string(sizeof(relock_stage)));
  Stage stage{stage_text(shown.name, "name"), stage_text(shown.sentence, "sentence"), {}};
  if (shown.picture.data) {
    stage.shown = picture_from_c(shown.picture);
  } else {
    stage.shown = chart_from_c(shown);
  }
  return stage;
}

}  // namespace relock::plugin
