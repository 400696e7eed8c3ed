// `relock detect`: any detector on single pictures.

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "cli/camera_file.h"
#include "cli/catalogue.h"
#include "cli/drawing.h"
#include "cli/files.h"
#include "cli/json_text.h"
#include "cli/poses.h"
#include "cli/stages.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "core/opencv.h"
#include "sequences/encoded_picture.h"

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

Json to_json(const std::optional<Covariance>& c) {
  return c ? Json{{"xx", c->xx}, {"xy", c->xy}, {"yy", c->yy}} : Json();
}

Json to_json(const Sighting& s) {
  Json json{{"code", s.code ? Json(to_string(*s.code)) : Json()},
            {"centre", to_json(s.centre)},
            {"centre_kind", to_string(s.centre_kind)},
            {"outline", to_json(s.outline)},
            {"confidence", s.confidence},
            {"blur", s.blur ? Json{{"direction_rad", s.blur->direction_rad}, {"length_px", s.blur->length_px}}
                            : Json()}};
  if (s.centre_covariance) json["centre_covariance_px2"] = to_json(s.centre_covariance);
  if (s.blur_covariance) json["blur_covariance_px2"] = to_json(s.blur_covariance);
  return json;
}

struct WrittenStage {
  std::string name, sentence, file;
};

struct Detection {
  std::string image;
  Size size;
  Sightings sightings;
  double ms = 0;
  std::vector<WrittenStage> stages;  ///< if they were asked for
  /// If they were asked for: of each sighting, and of the plate.
  std::vector<std::vector<pose::Pose>> poses = {};
  std::optional<std::vector<pose::Pose>> plate = {};
};

void print_json(const Detection& d) {
  Json sightings = Json::array();
  for (std::size_t i = 0; i < d.sightings.size(); ++i) {
    sightings.push_back(to_json(d.sightings[i]));
    if (!d.poses.empty()) sightings.back()["poses"] = json_of(d.poses[i]);
  }
  Json line{{"image", d.image},
            {"width", d.size.width},
            {"height", d.size.height},
            {"sightings", sightings},
            {"ms", std::round(d.ms * 1000) / 1000}};
  if (d.plate) line["plate"] = json_of(*d.plate);
  for (const auto& [name, sentence, file] : d.stages)
    line["stages"].push_back({{"name", name}, {"sentence", sentence}, {"file", file}});
  fmt::print("{}\n", line.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void print_text(const Detection& d) {
  for (std::size_t i = 0; i < d.stages.size(); ++i)
    fmt::print("{} {}: {} ({})\n", i + 1, d.stages[i].name, d.stages[i].sentence, d.stages[i].file);
  if (d.sightings.empty()) fmt::print("{}: nothing ({:.1f} ms)\n", d.image, d.ms);
  for (std::size_t i = 0; i < d.sightings.size(); ++i) {
    const Sighting& s = d.sightings[i];
    fmt::print("{}: {} at {:.2f}, {:.2f}, size {:.1f} px, confidence {:.2f} ({:.1f} ms)\n", d.image,
               s.code ? to_string(*s.code) : "something", s.centre.x, s.centre.y, size_of(s.outline),
               s.confidence, d.ms);
    if (!d.poses.empty()) fmt::print("{}", text_of(d.poses[i]));
  }
  if (d.plate) fmt::print("{}: the plate\n{}", d.image, text_of(*d.plate));
}

cv::Mat read_picture(const std::string& name) {
  if (!std::filesystem::exists(name)) throw Error(fmt::format("{} does not exist", name));
  if (std::filesystem::is_directory(name)) throw Error(fmt::format("{} is a folder, not a picture", name));
  const std::string bytes = read_file(name);
  try {
    return decode_picture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  } catch (const Error& fault) {
    throw Error(fmt::format("{}: {}", name, fault.what()));
  }
}

/// The detector as one that shows its stages. Throws Error when it is none.
ExplainingDetector& explaining(Detector& detector, const std::string& name, const Methods& methods) {
  auto* explaining = dynamic_cast<ExplainingDetector*>(&detector);
  if (explaining) return *explaining;
  const auto others = explaining_detectors(methods);
  throw Error(fmt::format(
      "{} does not show its stages; {}", name,
      others.empty() ? "no detector does" : fmt::format("these detectors do: {}", fmt::join(others, ", "))));
}

Detection detection_in(const cv::Mat& picture, const std::string& name, Detector& detector) {
  const auto begun = std::chrono::steady_clock::now();
  Detection detection{name, {picture.cols, picture.rows}, detector.detect(view(picture)), 0, {}};
  detection.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
  return detection;
}

std::vector<WrittenStage> explain_into(const std::filesystem::path& folder, const cv::Mat& picture,
                                       ExplainingDetector& detector) {
  const std::vector<Stage> stages = detector.explain(view(picture));
  const auto files = write_stages(stages, folder);
  std::vector<WrittenStage> written;
  for (std::size_t i = 0; i < stages.size(); ++i)
    written.push_back({stages[i].name, stages[i].sentence, files[i].string()});
  return written;
}

/// What poses are made from, if they were asked for.
std::optional<PoseQuestion> question_of(const DetectArguments& a) {
  if (!a.pose) return {};
  if (!a.camera) throw Error("a pose needs a calibrated camera: --camera FILE");
  PoseQuestion question{read_camera(*a.camera), a.size_m};
  if (a.layout) question.layout = read_layout(*a.layout);
  return question;
}

void add_poses(Detection& detection, const PoseQuestion& question) {
  check_question(question, detection.size);
  if (question.size_m)
    for (const Sighting& s : detection.sightings)
      detection.poses.push_back(pose::pose_of(question.camera, s, *question.size_m, question.accuracy));
  if (!question.layout.empty())
    detection.plate =
        pose::pose_of_plate(question.camera, detection.sightings, question.layout, question.accuracy);
}

}  // namespace

int detect(const DetectArguments& arguments, const Methods& methods) {
  const auto specs = parse_methods(arguments.method);
  if (specs.size() != 1) throw Error("detect takes one method");
  const DetectorEntry& entry = detector_entry(methods, specs[0].name);
  choose(methods, specs[0]);  // a plug-in that does not survive these options is told of in one sentence
  const Options options(entry.name, entry.options, specs[0].options);
  const auto detector = entry.make(options, 1);
  if (arguments.explain) explaining(*detector, entry.name, methods);
  const auto question = question_of(arguments);
  for (std::size_t i = 0; i < arguments.images.size(); ++i) {
    const std::string name = arguments.images[i].string();
    const cv::Mat picture = read_picture(name);
    Detection detection = detection_in(picture, name, *detector);
    if (arguments.explain)
      detection.stages =
          explain_into(numbered(arguments.out, i), picture, explaining(*detector, entry.name, methods));
    if (question) add_poses(detection, *question);
    arguments.json ? print_json(detection) : print_text(detection);
    if (arguments.draw) write_picture(numbered(*arguments.draw, i), drawn(picture, detection.sightings));
  }
  return 0;
}

}  // namespace relock
