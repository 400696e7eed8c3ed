// `relock detect`: any detector on single pictures.

#include <fmt/format.h>

#include <chrono>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/catalogue.h"
#include "cli/files.h"
#include "cli/json_text.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

Json to_json(Vec2 v) { return {v.x, v.y}; }

Json to_json(const Outline& outline) {
  if (const auto* box = std::get_if<Box>(&outline))
    return {{"box", {{"x", box->x}, {"y", box->y}, {"width", box->width}, {"height", box->height}}}};
  if (const auto* quad = std::get_if<Quad>(&outline)) {
    Json corners = Json::array();
    for (const Vec2& corner : quad->corner) corners.push_back(to_json(corner));
    return {{"quad", corners}};
  }
  const auto& e = std::get<Ellipse>(outline);
  return {{"ellipse",
           {{"centre", to_json(e.centre)},
            {"semi_major", e.semi_major},
            {"semi_minor", e.semi_minor},
            {"angle_rad", e.angle_rad}}}};
}

Json to_json(const Sighting& s) {
  return {{"code", s.code ? Json(to_string(*s.code)) : Json()},
          {"centre", to_json(s.centre)},
          {"centre_kind", to_string(s.centre_kind)},
          {"outline", to_json(s.outline)},
          {"confidence", s.confidence},
          {"blur", s.blur ? Json{{"direction_rad", s.blur->direction_rad}, {"length_px", s.blur->length_px}}
                          : Json()}};
}

struct Detection {
  std::string image;
  Size size;
  Sightings sightings;
  double ms = 0;
};

void print_json(const Detection& d) {
  Json sightings = Json::array();
  for (const Sighting& s : d.sightings) sightings.push_back(to_json(s));
  const Json line{{"image", d.image},
                  {"width", d.size.width},
                  {"height", d.size.height},
                  {"sightings", sightings},
                  {"ms", std::round(d.ms * 1000) / 1000}};
  fmt::print("{}\n", line.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void print_text(const Detection& d) {
  if (d.sightings.empty()) fmt::print("{}: nothing ({:.1f} ms)\n", d.image, d.ms);
  for (const Sighting& s : d.sightings)
    fmt::print("{}: {} at {:.2f}, {:.2f}, size {:.1f} px, confidence {:.2f} ({:.1f} ms)\n", d.image,
               s.code ? to_string(*s.code) : "something", s.centre.x, s.centre.y, size_of(s.outline),
               s.confidence, d.ms);
}

cv::Point to_point(Vec2 v, int shift) {
  const double scale = 1 << shift;
  return {static_cast<int>(std::lround(v.x * scale)), static_cast<int>(std::lround(v.y * scale))};
}

void draw_outline(cv::Mat& picture, const Outline& outline, const cv::Scalar& colour) {
  constexpr int shift = 4;  // sixteenths of a pixel
  if (const auto* e = std::get_if<Ellipse>(&outline)) {
    cv::ellipse(picture, to_point(e->centre, 0),
                {static_cast<int>(std::lround(e->semi_major)), static_cast<int>(std::lround(e->semi_minor))},
                e->angle_rad * 180 / CV_PI, 0, 360, colour, 1, cv::LINE_AA);
    return;
  }
  std::array<Vec2, 4> corners;
  if (const auto* quad = std::get_if<Quad>(&outline)) {
    corners = quad->corner;
  } else {
    const auto& b = std::get<Box>(outline);
    corners = {{{b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}}};
  }
  for (std::size_t i = 0; i < 4; ++i)
    cv::line(picture, to_point(corners[i], shift), to_point(corners[(i + 1) % 4], shift), colour, 1,
             cv::LINE_AA, shift);
}

cv::Mat drawn(cv::Mat picture, const Sightings& sightings) {
  if (picture.channels() == 1) cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  const cv::Scalar green(115, 158, 0), orange(0, 94, 213);  // Okabe and Ito
  for (const Sighting& s : sightings) {
    draw_outline(picture, s.outline, green);
    cv::drawMarker(picture, to_point(s.centre, 0), orange, cv::MARKER_CROSS, 9, 1, cv::LINE_AA);
    const std::string label = s.code ? to_string(*s.code) : fmt::format("{:.2f}", s.confidence);
    const Box box = bounds(s.outline);
    cv::putText(picture, label, to_point({box.x, box.y - 4}, 0), cv::FONT_HERSHEY_SIMPLEX, 0.4, orange, 1,
                cv::LINE_AA);
  }
  return picture;
}

void write_drawing(const std::filesystem::path& path, const cv::Mat& picture) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), picture);
  } catch (const cv::Exception&) {  // an ending that OpenCV does not know
  }
  if (!written)
    throw Error(fmt::format(
        "{} cannot be written; is its folder there, and does its name end in .png or .jpg?", path.string()));
}

cv::Mat read_picture(const std::string& name) {
  cv::Mat picture;
  try {
    picture = cv::imread(name, cv::IMREAD_ANYCOLOR);
  } catch (const cv::Exception&) {  // larger than OpenCV takes
  }
  if (picture.empty())
    throw Error(fmt::format(
        "{} {}", name, std::filesystem::exists(name) ? "is no picture that can be read" : "does not exist"));
  return picture;
}

}  // namespace

int detect(const DetectArguments& arguments, const Methods& methods) {
  const auto specs = parse_methods(arguments.method);
  if (specs.size() != 1) throw Error("detect takes one method");
  const DetectorEntry& entry = detector_entry(methods, specs[0].name);
  choose(methods, specs[0]);  // a plug-in that does not survive these options is told of in one sentence
  const Options options(entry.name, entry.options, specs[0].options);
  const auto detector = entry.make(options, 1);
  for (std::size_t i = 0; i < arguments.images.size(); ++i) {
    const std::string name = arguments.images[i].string();
    const cv::Mat picture = read_picture(name);
    const auto begun = std::chrono::steady_clock::now();
    Detection detection{name, {picture.cols, picture.rows}, detector->detect(view(picture)), 0};
    detection.ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    arguments.json ? print_json(detection) : print_text(detection);
    if (arguments.draw) write_drawing(numbered(*arguments.draw, i), drawn(picture, detection.sightings));
  }
  return 0;
}

}  // namespace relock
