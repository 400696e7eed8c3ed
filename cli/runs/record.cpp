#include "cli/runs/record.h"

#include <fmt/format.h>

#include "cli/files.h"
#include "cli/json_text.h"
#include "core/error.h"

namespace relock {
namespace {

Json to_json(const std::vector<std::optional<FrameIndex>>& frames) {
  Json all = Json::array();
  for (const auto& frame : frames) all.push_back(frame ? Json(*frame) : Json());
  return all;
}

Json to_json(const Failure& failure) {
  return {{"frame", failure.frame}, {"what", failure.what}, {"output", failure.output}};
}

Json to_json(const Anchor& anchor) {
  return {{"frame", anchor.frame}, {"direction", to_string(anchor.direction)}};
}

Json inputs_json(const RunRecord& r) {
  return {{"relock", r.relock_version},
          {"program", r.program},
          {"opencv", r.opencv_version},
          {"recording", r.recording},
          {"fingerprint", r.fingerprint},
          {"method", r.method},
          {"options", r.options},
          {"gaps", r.gaps},
          {"dropped", r.dropped},
          {"seed", r.seed},
          {"protocol", to_string(r.protocol)},
          {"anchor", r.anchor ? to_json(*r.anchor) : Json()},
          {"gate", r.gate.empty() ? Json() : Json(r.gate)},
          {"real_time", r.real_time.empty() ? Json() : Json(r.real_time)},
          {"latency", r.latency.empty() ? Json() : Json(r.latency)}};
}

Json to_json(const RunRecord& r) {
  Json failures = Json::array();
  for (const Failure& failure : r.failures) failures.push_back(to_json(failure));
  return {{"format", 1},
          {"inputs", inputs_json(r)},
          {"yardstick", r.yardstick},
          {"reads_codes", r.reads_codes},
          {"deterministic", r.deterministic},
          {"judged_from", to_json(r.judged_from)},
          {"failed_from", to_json(r.failed_from)},
          {"failures", failures},
          {"cut_short", r.cut_short ? to_json(*r.cut_short) : Json()}};
}

std::vector<std::optional<FrameIndex>> frames_from(const Json& json) {
  std::vector<std::optional<FrameIndex>> all;
  for (const Json& frame : json)
    all.push_back(frame.is_null() ? std::nullopt : std::optional(frame.get<FrameIndex>()));
  return all;
}

Failure failure_from(const Json& json) {
  return {json.at("frame").get<FrameIndex>(), json.at("what").get<std::string>(),
          json.at("output").get<std::string>()};
}

std::string text_or_nothing(const Json& json, const char* key) {
  const Json value = json.value(key, Json());
  return value.is_null() ? std::string() : value.get<std::string>();
}

RunRecord record_from(const Json& json) {
  RunRecord r;
  const Json& inputs = json.at("inputs");
  r.relock_version = inputs.at("relock");
  r.program = inputs.at("program");
  r.opencv_version = inputs.at("opencv");
  r.recording = inputs.at("recording");
  r.fingerprint = inputs.at("fingerprint");
  r.method = inputs.at("method");
  r.options = inputs.at("options").get<std::map<std::string, std::string>>();
  r.gaps = inputs.at("gaps");
  r.dropped = inputs.at("dropped").get<std::vector<FrameIndex>>();
  r.seed = inputs.at("seed");
  r.protocol = parse_protocol(inputs.at("protocol").get<std::string>());
  if (const Json anchor = inputs.value("anchor", Json()); !anchor.is_null())
    r.anchor = Anchor{anchor.at("frame"), parse_direction(anchor.at("direction").get<std::string>())};
  if (!inputs.at("gate").is_null()) r.gate = inputs.at("gate");
  r.real_time = text_or_nothing(inputs, "real_time");
  r.latency = text_or_nothing(inputs, "latency");
  r.yardstick = json.at("yardstick");
  r.reads_codes = json.at("reads_codes");
  r.deterministic = json.at("deterministic");
  r.judged_from = frames_from(json.at("judged_from"));
  r.failed_from = frames_from(json.at("failed_from"));
  for (const Json& failure : json.at("failures")) r.failures.push_back(failure_from(failure));
  if (!json.at("cut_short").is_null()) r.cut_short = failure_from(json.at("cut_short"));
  return r;
}

/// What must be the same for runs to stand in one table: the inputs but the method and the program.
Json conditions(const RunRecord& record) {
  Json inputs = inputs_json(record);
  for (const char* own : {"relock", "program", "opencv", "method", "options"}) inputs.erase(own);
  return inputs;
}

}  // namespace

bool RunRecord::same_inputs(const RunRecord& other) const { return inputs_json(*this) == inputs_json(other); }

bool RunRecord::same_conditions(const RunRecord& other) const {
  return conditions(*this) == conditions(other);
}

std::string spoken(const Showing& showing) {
  std::string text = fmt::format("protocol {}", to_string(showing.protocol));
  if (showing.anchor) text += fmt::format(" from {}", to_string(*showing.anchor));
  if (!showing.real_time.empty())
    text += fmt::format(", real time {}, latency {}", showing.real_time, showing.latency);
  return text;
}

std::string to_json_text(const RunRecord& record) { return json_text(to_json(record)); }

RunRecord parse_record(const std::string& text, const std::string& name) {
  try {
    return record_from(Json::parse(text));
  } catch (const std::exception& fault) {
    throw Error(fmt::format("{} is no run.json of this relock ({}); remove its folder and run again", name,
                            fault.what()));
  }
}

RunRecord read_record(const std::filesystem::path& path) {
  return parse_record(read_file(path), path.string());
}

}  // namespace relock
