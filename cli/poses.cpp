#include "cli/poses.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/toml_table.h"

namespace relock {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kUnlikely = 0.01;

double deviation(const pose::Pose& pose, int axis) {
  return std::sqrt(std::max(pose.covariance(axis, axis), 0.0));
}

/// Between the normal and the line of sight.
double tilt_deg(const pose::Pose& pose) {
  const double cosine = -pose.normal.dot(pose.position.normalized());
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees;
}

Json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

pose::Placed placed(const toml::node& node, const TomlTable& file) {
  const toml::table* entry = node.as_table();
  if (!entry) file.fail(node, "each marker is a table: [[marker]]");
  const TomlTable table(*entry, file.file(), {"code", "x_m", "y_m"});
  const auto code = table.word("code");
  const auto x = table.value<double>("x_m", "a number"), y = table.value<double>("y_m", "a number");
  if (!code || !x || !y) table.fail(node, "a marker needs code, x_m and y_m");
  return {parse_code(*code), {*x, *y}};
}

}  // namespace

std::vector<pose::Placed> read_layout(const std::filesystem::path& file) {
  const toml::table parsed = parse_toml(file);
  const TomlTable table(parsed, file.string(), {"marker"});
  std::vector<pose::Placed> plate;
  for (const toml::node* node : table.list("marker")) plate.push_back(placed(*node, table));
  if (plate.size() < 4)
    throw Error(fmt::format("{}: a plate's pose needs four markers or more, and {} are there", file.string(),
                            plate.size()));
  return plate;
}

void check_question(const PoseQuestion& question, Size picture) {
  if (!question.size_m && question.layout.empty())
    throw Error("a pose needs a size: --size METRES (diameter or side), or --layout FILE");
  if (question.size_m && !(*question.size_m > 0)) throw Error("--size must be above 0 m");
  const Size own = question.camera.picture;
  if (own.width > 0 && own != picture)
    throw Error(fmt::format("the camera is calibrated for pictures of {}x{}, and this one is {}x{}",
                            own.width, own.height, picture.width, picture.height));
}

std::string text_of(const std::vector<pose::Pose>& poses) {
  std::string text;
  for (const pose::Pose& pose : poses) {
    if (pose.probability < kUnlikely) continue;
    const auto& p = pose.position;
    text += fmt::format(
        "  {} {:.4f}, {:.4f}, {:.4f} m (± {:.1f}, {:.1f}, {:.1f} mm), normal {:.3f}, {:.3f}, {:.3f} "
        "(± {:.2f} degrees), tilted by {:.1f} degrees{}{}\n",
        text.empty() ? "at" : "or at", p.x(), p.y(), p.z(), 1e3 * deviation(pose, 0),
        1e3 * deviation(pose, 1), 1e3 * deviation(pose, 2), pose.normal.x(), pose.normal.y(), pose.normal.z(),
        kDegrees * pose.normal_deviation_rad(), tilt_deg(pose), pose.rotation ? "" : ", its turn unknown",
        pose.probability < 1 - kUnlikely ? fmt::format(": {:.0f} % likely", 100 * pose.probability) : "");
  }
  return text.empty() ? "  no pose\n" : text;
}

Json json_of(const std::vector<pose::Pose>& poses) {
  Json all = Json::array();
  for (const pose::Pose& pose : poses) {
    if (pose.probability < kUnlikely) continue;
    Json covariance = Json::array();
    for (int row = 0; row < 6; ++row) {
      Json line = Json::array();
      for (int column = 0; column < 6; ++column) line.push_back(pose.covariance(row, column));
      covariance.push_back(line);
    }
    Json json{{"position_m", to_json(pose.position)},
              {"normal", to_json(pose.normal)},
              {"rotation_xyzw", Json()},
              {"covariance", covariance},
              {"normal_deviation_deg", kDegrees * pose.normal_deviation_rad()},
              {"probability", pose.probability}};
    if (pose.rotation)
      json["rotation_xyzw"] = {pose.rotation->x(), pose.rotation->y(), pose.rotation->z(),
                               pose.rotation->w()};
    all.push_back(std::move(json));
  }
  return all;
}

}  // namespace relock
