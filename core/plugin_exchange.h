#pragma once

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/frame.h"
#include "core/plugin_abi.h"
#include "core/sighting.h"

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

}  // namespace relock::plugin
