#include "cli/labelling/key_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.h"

namespace relock {
namespace {

constexpr const char* kFormat = "relock key frames";
constexpr int kVersion = 1;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFar_px = 1e6;  // no place in a picture

/// Numbers of a list of just so many.
std::vector<double> numbers(const Json& list, std::size_t count, const char* what) {
  if (!list.is_array() || list.size() != count)
    throw Error(fmt::format("\"{}\" is a list of {} numbers", what, count));
  std::vector<double> all;
  for (const Json& each : list) {
    if (!each.is_number() || !(std::abs(each.get<double>()) < kFar_px))
      throw Error(fmt::format("\"{}\" holds something that is no place in a picture", what));
    all.push_back(each.get<double>());
  }
  return all;
}

std::optional<Outline> parse_outline(const Json& json) {
  std::optional<Outline> outline;
  if (json.contains("box")) {
    const auto n = numbers(json["box"], 4, "box");
    outline = Box{n[0], n[1], n[2], n[3]};
  } else if (json.contains("quad")) {
    const auto n = numbers(json["quad"], 8, "quad");
    outline = Quad{{Vec2{n[0], n[1]}, Vec2{n[2], n[3]}, Vec2{n[4], n[5]}, Vec2{n[6], n[7]}}};
  } else if (json.contains("ellipse")) {
    const auto n = numbers(json["ellipse"], 5, "ellipse");
    Ellipse e{{n[0], n[1]},
              std::max(n[2], n[3]),
              std::min(n[2], n[3]),
              (n[2] >= n[3] ? n[4] : n[4] + 90) * kDegree};
    e.angle_rad -= std::numbers::pi * std::floor(e.angle_rad / std::numbers::pi);
    outline = e;
  }
  if (outline && !well_formed(*outline)) throw Error("an outline has no size");
  return outline;
}

Json parsed(const std::string& text, const std::string& name) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& fault) {
    const auto line =
        1 + std::count(text.begin(),
                       text.begin() + static_cast<std::ptrdiff_t>(std::min(fault.byte, text.size())), '\n');
    throw Error(fmt::format("{}:{}: it is broken here; mend it, or move it away to begin anew", name, line));
  }
}

void check_recording(const Json& of, const std::string& name, const KeyedRecording& recording) {
  const std::size_t frames = of.at("frames");
  if (of.at("pictures") == recording.pictures && frames == recording.frames) return;
  throw Error(fmt::format(
      "{} was made for another recording, {} ({} frames of {}x{}; {} has {} of {}x{}, and other "
      "pictures); move it away, or name another file with --labels",
      name, of.at("name").get<std::string>(), frames, of.at("width").get<int>(), of.at("height").get<int>(),
      recording.name, recording.frames, recording.picture.width, recording.picture.height));
}

KeyedTarget parse_target(const Json& json, const KeyedRecording& recording) {
  KeyedTarget target{json.at("id"), {}};
  for (const Json& each : json.at("keys")) {
    KeyFrame key = parse_key(each, recording);
    const std::size_t before = target.keys.size();
    const std::size_t frame = key.frame;
    put_key(target, std::move(key));
    if (target.keys.size() == before)
      throw Error(fmt::format("target {} has two key frames on frame {}", target.id, frame));
  }
  return target;
}

}  // namespace

KeyedRecording keyed_recording(const Sequence& sequence) {
  return {sequence.recording.name, sequence.recording.frames(), sequence.recording.picture,
          sequence.fingerprint};
}

std::filesystem::path key_file_of(const std::filesystem::path& labels) {
  return labels.parent_path() / (labels.stem().string() + ".keys.json");
}

void add_outline(Json& json, const Outline& outline) {
  if (const auto* box = std::get_if<Box>(&outline)) {
    json["box"] = {box->x, box->y, box->width, box->height};
  } else if (const auto* quad = std::get_if<Quad>(&outline)) {
    Json corners = Json::array();
    for (const Vec2 corner : quad->corner) {
      corners.push_back(corner.x);
      corners.push_back(corner.y);
    }
    json["quad"] = corners;
  } else {
    const auto& e = std::get<Ellipse>(outline);
    json["ellipse"] = {e.centre.x, e.centre.y, e.semi_major, e.semi_minor, e.angle_rad / kDegree};
  }
}

Json to_json(const KeyFrame& key) {
  Json json{{"frame", key.frame}, {"state", to_string(key.state)}};
  if (key.outline) {
    add_outline(json, *key.outline);
    json["sigma_px"] = key.sigma_px;
  }
  json["source"] = to_string(key.source);
  return json;
}

KeyFrame parse_key(const Json& json, const KeyedRecording& recording) {
  KeyFrame key;
  const auto& frame = json.at("frame");
  if (!frame.is_number_unsigned() || frame.get<std::size_t>() >= recording.frames)
    throw Error(fmt::format("frame {} does not exist in {} (it has {} frames, from 0)", frame.dump(),
                            recording.name, recording.frames));
  key.frame = frame;
  key.state = parse_key_state(json.at("state").get<std::string>());
  key.outline = parse_outline(json);
  key.sigma_px = json.value("sigma_px", 1.0);
  key.source = parse_label_source(json.value("source", "hand"));
  if (!(key.sigma_px >= 0.01 && key.sigma_px <= 1000)) throw Error("sigma_px must be from 0.01 to 1000");
  if (key.state == KeyState::placed && !key.outline) throw Error("a placed key frame needs an outline");
  if (key.state == KeyState::placed && share_inside(*key.outline, picture_box(recording.picture)) == 0)
    throw Error("the outline lies outside the picture; say absent if that is meant");
  return key;
}

std::string to_json_text(const KeyDocument& document) {
  const KeyedRecording& r = document.recording;
  Json targets = Json::array();
  for (const KeyedTarget& target : document.targets) {
    Json keys = Json::array();
    for (const KeyFrame& key : target.keys) keys.push_back(to_json(key));
    targets.push_back({{"id", target.id}, {"keys", keys}});
  }
  return json_text({{"format", kFormat},
                    {"version", kVersion},
                    {"recording",
                     {{"name", r.name},
                      {"frames", r.frames},
                      {"width", r.picture.width},
                      {"height", r.picture.height},
                      {"pictures", r.pictures}}},
                    {"max_gap_s", document.max_gap_s},
                    {"labels", document.labels},
                    {"targets", targets}});
}

KeyDocument parse_keys(const std::string& text, const std::string& name, const KeyedRecording& recording) {
  const Json json = parsed(text, name);
  try {
    if (!json.is_object() || json.value("format", "") != kFormat)
      throw Error("it holds no key frames of relock; move it away, or name another file with --labels");
    if (json.at("version").get<int>() > kVersion)
      throw Error("it was written by a newer relock; use that one, or name another file with --labels");
    check_recording(json.at("recording"), name, recording);
    KeyDocument document{recording, json.at("max_gap_s"), json.at("labels"), {}};
    for (const Json& each : json.at("targets")) document.targets.push_back(parse_target(each, recording));
    return document;
  } catch (const Error& fault) {
    const std::string what = fault.what();
    throw Error(what.starts_with(name) ? what : fmt::format("{}: {}", name, what));
  } catch (const Json::exception&) {
    throw Error(
        fmt::format("{}: something is missing from it, or of another kind; mend it, or move it away to begin "
                    "anew",
                    name));
  }
}

}  // namespace relock
