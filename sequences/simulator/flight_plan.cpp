#include "sequences/simulator/flight_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <variant>

#include "core/error.h"
#include "core/toml_table.h"
#include "sequences/description.h"
#include "sequences/gaps.h"
#include "sequences/simulator/range.h"

namespace relock::simulator {
namespace {

using OptionalPath = std::optional<std::filesystem::path>;

/// A value that is one of some words.
struct Word {
  std::vector<std::string> words;
  std::function<int()> get;
  std::function<void(int)> set;
};

template <class Enum>
Word word(Enum& value, std::vector<std::string> words) {
  return {std::move(words), [&value] { return static_cast<int>(value); },
          [&value](int i) { value = static_cast<Enum>(i); }};
}

/// A quantity of a plan by the name of its table and its own: the one list that reading and writing go by.
struct Field {
  std::string table, key;
  std::variant<double*, int*, bool*, std::string*, OptionalPath*, Word> value;
};

std::vector<Field> fields_of(FlightPlan& p) {
  std::vector<Field> fields{
      {"", "duration_s", &p.duration_s},
      {"camera", "width", &p.camera.width},
      {"camera", "height", &p.camera.height},
      {"camera", "diagonal_deg", &p.camera.diagonal_deg},
      {"camera", "rate_hz", &p.camera.rate_hz},
      {"camera", "k1", &p.camera.k1},
      {"camera", "k2", &p.camera.k2},
      {"timing", "jitter_ms", &p.timing.jitter_ms},
      {"timing", "gaps", &p.timing.gaps},
      {"motion", "path", word(p.motion.path, {"hover", "approach", "fly-past", "revolve"})},
      {"motion", "distance_m", &p.motion.distance_m},
      {"motion", "nearest_m", &p.motion.nearest_m},
      {"motion", "path_period_s", &p.motion.path_period_s},
      {"motion", "sweep_m", &p.motion.sweep_m},
      {"motion", "drift_m", &p.motion.drift_m},
      {"motion", "drift_hz", &p.motion.drift_hz},
      {"motion", "sway_deg", &p.motion.sway_deg},
      {"motion", "sway_hz", &p.motion.sway_hz},
      {"motion", "vibration_deg", &p.motion.vibration_deg},
      {"motion", "vibration_hz", &p.motion.vibration_hz},
      {"motion", "steps_hz", &p.motion.steps_hz},
      {"motion", "step_deg", &p.motion.step_deg},
      {"motion", "step_s", &p.motion.step_s},
      {"motion", "strokes_hz", &p.motion.strokes_hz},
      {"motion", "stroke_deg", &p.motion.stroke_deg},
      {"motion", "stroke_s", &p.motion.stroke_s},
      {"motion", "most_rate_deg_s", &p.motion.most_rate_deg_s},
      {"exposure", "time_ms", &p.exposure.time_ms},
      {"exposure", "automatic", &p.exposure.automatic},
      {"exposure", "longest_ms", &p.exposure.longest_ms},
      {"exposure", "light", &p.exposure.light},
      {"exposure", "light_end", &p.exposure.light_end},
      {"exposure", "readout_ms", &p.exposure.readout_ms},
      {"exposure", "step_px", &p.exposure.step_px},
      {"exposure", "most_steps", &p.exposure.most_steps},
      {"scene", "arrangement", word(p.scene.arrangement, {"wall", "box", "paper"})},
      {"scene", "spacing_m", &p.scene.spacing_m},
      {"scene", "box_side_m", &p.scene.box_side_m},
      {"scene", "clutter", &p.scene.clutter},
      {"scene", "background", &p.scene.background},
      {"scene", "light_gradient", &p.scene.light_gradient},
      {"scene", "shadows", &p.scene.shadows},
      {"scene", "gloss", &p.scene.gloss},
      {"scene", "occluders_hz", &p.scene.occluders_hz},
      {"sensor", "full_well_e", &p.sensor.full_well_e},
      {"sensor", "read_noise_e", &p.sensor.read_noise_e},
      {"sensor", "vignetting", &p.sensor.vignetting},
      {"sensor", "defocus_px", &p.sensor.defocus_px},
      {"sensor", "srgb", &p.sensor.srgb},
      {"sensor", "sharpening", &p.sensor.sharpening},
      {"transport", "jpeg_quality", &p.transport.jpeg_quality},
      {"transport", "h264_kbps", &p.transport.h264_kbps},
  };
  return fields;
}

void read_word(const TomlTable& table, const std::string& key, const Word& word) {
  const auto said = table.word(key);
  if (!said) return;
  for (std::size_t i = 0; i < word.words.size(); ++i)
    if (word.words[i] == *said) return word.set(static_cast<int>(i));
  table.fail(*table.node(key), fmt::format("{} must be one of {}", key, fmt::join(word.words, ", ")));
}

void read_field(const TomlTable& table, const Field& field, const std::filesystem::path& folder) {
  const std::string& key = field.key;
  if (const auto* number = std::get_if<double*>(&field.value)) {
    const auto said = table.value<double>(key, "a number");
    if (said && !std::isfinite(*said)) table.fail(*table.node(key), fmt::format("{} must be finite", key));
    **number = said.value_or(**number);
  } else if (const auto* whole = std::get_if<int*>(&field.value)) {
    **whole = table.value<int>(key, "a whole number").value_or(**whole);
  } else if (const auto* flag = std::get_if<bool*>(&field.value)) {
    **flag = table.value<bool>(key, "true or false").value_or(**flag);
  } else if (const auto* text = std::get_if<std::string*>(&field.value)) {
    **text = table.word(key).value_or(**text);
  } else if (const auto* path = std::get_if<OptionalPath*>(&field.value)) {
    if (const auto said = table.word(key)) **path = folder / *said;
  } else {
    read_word(table, key, std::get<Word>(field.value));
  }
}

std::string number_text(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string value_text(const Field& field) {
  if (const auto* number = std::get_if<double*>(&field.value)) return number_text(**number);
  if (const auto* whole = std::get_if<int*>(&field.value)) return fmt::format("{}", **whole);
  if (const auto* flag = std::get_if<bool*>(&field.value)) return **flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string*>(&field.value)) return toml_string(**text);
  if (const auto* path = std::get_if<OptionalPath*>(&field.value))
    return **path ? toml_string((**path)->string()) : "";
  const Word& word = std::get<Word>(field.value);
  return toml_string(word.words[static_cast<std::size_t>(word.get())]);
}

const std::vector<std::string> kTables{"camera", "timing", "motion",   "exposure",
                                       "scene",  "sensor", "transport"};

std::vector<std::string> keys_of(const std::vector<Field>& fields, const std::string& table) {
  std::vector<std::string> keys;
  for (const Field& field : fields)
    if (field.table == table) keys.push_back(field.key);
  return keys;
}

/// A node that must be a table.
const toml::table& table_at(const TomlTable& owner, const toml::node& node, const std::string& name) {
  if (const toml::table* table = node.as_table()) return *table;
  owner.fail(node, fmt::format("{} must be a table", name));
}

void read_table(const TomlTable& root, const std::string& name, const std::vector<Field>& fields,
                const std::filesystem::path& folder) {
  const toml::node* node = root.node(name);
  if (!node) return;
  const TomlTable table(table_at(root, *node, name), root.file(), keys_of(fields, name));
  for (const Field& field : fields)
    if (field.table == name) read_field(table, field, folder);
}

void read_targets(const TomlTable& root, FlightPlan& plan) {
  const auto nodes = root.list("target");
  if (!nodes.empty()) plan.targets.clear();
  for (const toml::node* node : nodes) {
    const TomlTable table(table_at(root, *node, "target"), root.file(), {"name", "size_m"});
    PlannedTarget target;
    target.name = table.word("name").value_or(target.name);
    target.size_m = table.positive("size_m", 1e-3, 3).value_or(target.size_m);
    plan.targets.push_back(target);
  }
}

}  // namespace

FlightPlan read_flight_plan(const std::filesystem::path& file) {
  const toml::table parsed = parse_toml(file);
  std::vector<std::string> known{"preset", "seed", "duration_s", "target"};
  known.insert(known.end(), kTables.begin(), kTables.end());
  const TomlTable root(parsed, file.string(), known);
  FlightPlan plan = flight_preset(root.word("preset").value_or("ardrone"));
  const auto seed = root.value<std::int64_t>("seed", "a whole number");
  if (seed && *seed < 0) root.fail(*root.node("seed"), "seed must be a whole number from 0");
  if (seed) plan.seed = static_cast<std::uint64_t>(*seed);
  const auto fields = fields_of(plan);
  for (const Field& field : fields)
    if (field.table.empty()) read_field(root, field, file.parent_path());
  for (const std::string& table : kTables) read_table(root, table, fields, file.parent_path());
  read_targets(root, plan);
  try {
    check_flight_plan(plan);
  } catch (const Error& fault) {
    throw Error(fmt::format("{}: {}", file.string(), fault.what()));
  }
  return plan;
}

std::string flight_plan_text(const FlightPlan& plan) {
  FlightPlan copy = plan;
  const auto fields = fields_of(copy);
  std::string text = fmt::format("preset = {}\nseed = {}\n", toml_string(plan.preset), plan.seed), table;
  for (const Field& field : fields) {
    if (field.table != table) text += fmt::format("\n[{}]\n", table = field.table);
    if (const std::string value = value_text(field); !value.empty())
      text += fmt::format("{} = {}\n", field.key, value);
  }
  for (const PlannedTarget& target : plan.targets)
    text += fmt::format("\n[[target]]\nname = {}\nsize_m = {}\n", toml_string(target.name),
                        number_text(target.size_m));
  return text;
}

void check_flight_plan(const FlightPlan& plan) {
  check_range("duration_s", plan.duration_s, 0.01, 86400);
  check_range("camera: rate_hz", plan.camera.rate_hz, 1, 1000);
  check_range("camera: diagonal_deg", plan.camera.diagonal_deg, 5, 170);
  const double period_s = 1 / plan.camera.rate_hz;
  check_range("timing: jitter_ms", plan.timing.jitter_ms, 0, 1000 * period_s / 3);
  GapPattern::parse(plan.timing.gaps);
  check_motion(plan.motion);
  check_exposure(plan.exposure, period_s);
  check_scene(plan.scene);
  check_sensor(plan.sensor);
  check_transport(plan.transport);
  if (plan.targets.empty()) throw Error("a flight needs a target");
  for (const PlannedTarget& target : plan.targets) check_range("target: size_m", target.size_m, 1e-3, 3);
  if (plan.motion.path == Path::revolve && plan.motion.distance_m < plan.scene.box_side_m)
    throw Error("motion: distance_m brings the camera into the box that it revolves round");
}

}  // namespace relock::simulator
