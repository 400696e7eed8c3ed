#include "sequences/simulator/room.h"

namespace relock::simulator {

Room room_for(const ScenePlan& plan) {
  constexpr double kWidth = 6, kDepth = 6, kCeiling = -1.7, kFloor = 1.3, kBehindSheet = 0.001;
  const double far = plan.arrangement == Arrangement::box ? plan.box_side_m / 2 + kDepth / 2 : kBehindSheet;
  return {{-kWidth / 2, kCeiling, far - kDepth}, {kWidth / 2, kFloor, far}};
}

Surface side_of(const Room& room, Side side) {
  const Eigen::Vector3d size = room.high - room.low;
  const Eigen::Vector3d x{size.x(), 0, 0}, y{0, size.y(), 0}, z{0, 0, size.z()};
  const Eigen::Vector3d& low = room.low;
  Surface made;
  const auto spans = [&](const Eigen::Vector3d& corner, const Eigen::Vector3d& right,
                         const Eigen::Vector3d& down) {
    made.corner = corner;
    made.right = right;
    made.down = down;
  };
  switch (side) {
    case Side::faced:
      spans(low + z, x, y);
      break;
    case Side::left:
      spans(low, z, y);
      break;
    case Side::right:
      spans(low + x + z, -z, y);
      break;
    case Side::behind:
      spans(low + x, -x, y);
      break;
    case Side::floor:
      spans(low + y + z, x, -z);
      break;
    case Side::ceiling:
      spans(low, x, z);
      break;
  }
  return made;
}

Surface part_of(const Surface& whole, const cv::Rect2d& area) {
  const Eigen::Vector3d right = whole.right.normalized(), down = whole.down.normalized();
  Surface part = whole;
  part.corner += area.x * right + area.y * down;
  part.right = area.width * right;
  part.down = area.height * down;
  return part;
}

cv::Size2d extent(const Surface& surface) { return {surface.right.norm(), surface.down.norm()}; }

}  // namespace relock::simulator
