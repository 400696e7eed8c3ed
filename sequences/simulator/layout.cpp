#include "sequences/simulator/layout.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/error.h"

namespace relock::simulator {
namespace {

using Eigen::Vector3d;

Surface upright(const Vector3d& middle, const Vector3d& right, double width, double height) {
  Surface made;
  made.right = width * right;
  made.down = height * Vector3d::UnitY();
  made.corner = middle - 0.5 * (made.right + made.down);
  return made;
}

// 0, 1, -1, 2, -2, …: the first in the middle and the others around it.
int step_of(std::size_t index) {
  const int half = static_cast<int>((index + 1) / 2);
  return index % 2 == 1 ? half : -half;
}

Surface on_wall(const ScenePlan& plan, std::size_t index, std::size_t count, double sheet_m) {
  const std::size_t columns = count >= 4 ? (count + 1) / 2 : count;
  // The paper's second marker hangs to the left.
  const int step = plan.arrangement == Arrangement::paper ? -step_of(index) : step_of(index % columns);
  const std::size_t row = plan.arrangement == Arrangement::paper ? 0 : index / columns;
  const Vector3d middle{step * plan.spacing_m, static_cast<double>(row) * plan.spacing_m, 0};
  return upright(middle, Vector3d::UnitX(), sheet_m, sheet_m);
}

// Which way the top edge of side `index` runs: front, right, back, left.
Vector3d edge_of(std::size_t index) {
  const Vector3d edges[] = {Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitX(), -Vector3d::UnitZ()};
  return edges[index];
}

Surface beside_box(const ScenePlan& plan, std::size_t index, double away, double width, double height) {
  const Vector3d axis{0, 0, plan.box_side_m / 2};
  const Vector3d facing = -edge_of(index).cross(Vector3d::UnitY());
  return upright(axis + away * facing, edge_of(index), width, height);
}

void check_count(const ScenePlan& plan, std::size_t count) {
  if (count == 0) throw Error("a scene needs at least one target; name one");
  const std::size_t places = plan.arrangement == Arrangement::box     ? 4
                             : plan.arrangement == Arrangement::paper ? 3
                                                                      : count;
  if (count > places)
    throw Error(fmt::format("{} targets are too many: {} has places for {}", count,
                            plan.arrangement == Arrangement::box ? "the box" : "the paper's arrangement",
                            places));
}

void check_room_for(const ScenePlan& plan, const std::vector<PrintedTarget>& targets) {
  double widest = 0;
  for (const PrintedTarget& target : targets) widest = std::max(widest, target.sheet_m);
  const bool box = plan.arrangement == Arrangement::box;
  if (box && widest > plan.box_side_m)
    throw Error(fmt::format("a sheet of {} m does not fit on a box of {} m; make the box larger", widest,
                            plan.box_side_m));
  if (!box && targets.size() > 1 && widest > plan.spacing_m)
    throw Error(fmt::format("sheets of {} m overlap when they hang {} m apart; increase the spacing", widest,
                            plan.spacing_m));
}

void check_on_wall(const Surface& sheet, const Room& room) {
  const Vector3d last = sheet.corner + sheet.right + sheet.down;
  if (sheet.corner.x() < room.low.x() || sheet.corner.y() < room.low.y() || last.x() > room.high.x() ||
      last.y() > room.high.y())
    throw Error("the targets do not all fit on the wall of 6 x 3 m; decrease the spacing or their number");
}

}  // namespace

std::vector<Surface> sheets_of(const ScenePlan& plan, const std::vector<PrintedTarget>& targets,
                               const Room& room) {
  check_count(plan, targets.size());
  check_room_for(plan, targets);
  std::vector<Surface> sheets;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double side = targets[i].sheet_m;
    if (plan.arrangement == Arrangement::box) {
      sheets.push_back(beside_box(plan, i, plan.box_side_m / 2, side, side));
    } else {
      sheets.push_back(on_wall(plan, i, targets.size(), side));
      check_on_wall(sheets.back(), room);
    }
  }
  return sheets;
}

std::vector<Surface> box_of(const ScenePlan& plan, const Room& room) {
  constexpr double kUnderSheet = 0.001;
  const double half = plan.box_side_m / 2 - kUnderSheet, post = 0.25 * plan.box_side_m;
  const Vector3d axis{0, 0, plan.box_side_m / 2};
  std::vector<Surface> made(10);
  // Seen from below, the post is before the bottom; seen from above, the sides are before the post.
  Surface& bottom = made.front();
  bottom.corner = axis + Vector3d(-half, half, -half);
  bottom.right = 2 * half * Vector3d::UnitX();
  bottom.down = 2 * half * Vector3d::UnitZ();
  for (std::size_t i = 0; i < 4; ++i) {
    made[1 + i] = beside_box(plan, i, post / 2, post, room.high.y() - half);
    made[1 + i].corner.y() = half;
    made[5 + i] = beside_box(plan, i, half, 2 * half, 2 * half);
  }
  Surface& top = made.back();
  top.corner = axis + Vector3d(-half, -half, half);
  top.right = 2 * half * Vector3d::UnitX();
  top.down = -2 * half * Vector3d::UnitZ();
  return made;
}

}  // namespace relock::simulator
