#include "sequences/simulator/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "core/display_coding.h"
#include "core/error.h"
#include "core/random.h"
#include "sequences/encoded_picture.h"
#include "sequences/simulator/clutter.h"
#include "sequences/simulator/layout.h"
#include "sequences/simulator/light.h"
#include "sequences/simulator/occluder.h"
#include "sequences/simulator/range.h"
#include "sequences/simulator/room.h"

namespace relock::simulator {
namespace {

using Eigen::Vector3d;

// What random numbers are drawn for: a change of one draws the others as before.
enum Purpose : std::uint64_t { kLight, kRoom, kClutter, kPoster, kBox, kOccluder };

constexpr Side kAllSides[] = {Side::floor, Side::ceiling, Side::behind, Side::left, Side::right, Side::faced};
constexpr double kFinestWall = 700;  // texels per m: a target of 0.15 m is seen at up to 220 px
constexpr double kPatchTexels = 1.4e6;
constexpr int kWidestSheet = 768;

// The user's picture, cut to the form of the wall and no larger than is worth its memory.
cv::Mat read_background(const std::filesystem::path& path, const cv::Size2d& wall) {
  constexpr int kWidest = 2048;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(fmt::format("background {} cannot be read", path.string()));
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
  cv::Mat picture;
  try {
    picture = decode_picture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  } catch (const Error&) {
    throw Error(
        fmt::format("background {} is no picture, or it is damaged; give a JPEG or PNG file", path.string()));
  }
  const double form = std::min(picture.cols / wall.width, picture.rows / wall.height);
  const int width = std::max(1, static_cast<int>(form * wall.width)),
            height = std::max(1, static_cast<int>(form * wall.height));
  picture = picture(cv::Rect((picture.cols - width) / 2, (picture.rows - height) / 2, width, height));
  if (width <= kWidest) return picture;
  cv::Mat smaller;
  cv::resize(picture, smaller, {kWidest, std::max(1, height * kWidest / width)}, 0, 0, cv::INTER_AREA);
  return smaller;
}

// Paper and print as they are: the printed picture's black and white are 0.04 and 0.85 of the light.
cv::Mat printed(const cv::Mat& picture) {
  constexpr float kBlack = 0.04f, kWhite = 0.85f;
  cv::Mat table(1, 256, CV_8UC1), made;
  for (int i = 0; i < 256; ++i) {
    const double share = kBlack + (kWhite - kBlack) * light_of_coded(i / 255.0);
    table.at<uchar>(i) = cv::saturate_cast<uchar>(255 * coded_of_light(share));
  }
  cv::LUT(picture, table, made);
  return made;
}

class Builder {
 public:
  Builder(const ScenePlan& plan, const std::vector<PrintedTarget>& targets, std::uint64_t seed)
      : plan_(plan),
        targets_(targets),
        random_(seed),
        room_(room_for(plan)),
        sheets_(sheets_of(plan, targets, room_)),
        light_(plan, room_, scene_.lamp, middles(sheets_), random_.fork(kLight)) {}

  Scene build() {
    for (const Side side : kAllSides) add_side(side);
    if (plan_.arrangement == Arrangement::box) add_box();
    add_sheets();
    add_occluders();
    return std::move(scene_);
  }

 private:
  static std::vector<Vector3d> middles(const std::vector<Surface>& surfaces) {
    std::vector<Vector3d> found;
    for (const Surface& surface : surfaces) found.push_back(middle_of(surface));
    return found;
  }

  void add(Surface surface, const cv::Mat& picture, double light_cell_m) {
    surface.texture = std::make_shared<Texture>(make_texture(picture, light_.over(surface, light_cell_m)));
    scene_.surfaces.push_back(std::move(surface));
  }

  // The sheets as they hang on the wall that is faced, m from its corner.
  std::vector<cv::Rect2d> sheets_on_wall() const {
    std::vector<cv::Rect2d> found;
    if (plan_.arrangement == Arrangement::box) return found;
    for (const Surface& sheet : sheets_)
      found.emplace_back(sheet.corner.x() - room_.low.x(), sheet.corner.y() - room_.low.y(),
                         sheet.right.norm(), sheet.down.norm());
    return found;
  }

  // Around all sheets: painted finer, and kept free of what is part of the wall.
  std::optional<cv::Rect2d> around_sheets(const cv::Size2d& wall) const {
    constexpr double kMargin = 0.35;
    const std::vector<cv::Rect2d> sheets = sheets_on_wall();
    if (sheets.empty()) return {};
    cv::Rect2d all = sheets.front();
    for (const cv::Rect2d& sheet : sheets) all |= sheet;
    all -= cv::Point2d(kMargin, kMargin);
    all += cv::Size2d(2 * kMargin, 2 * kMargin);
    return all & cv::Rect2d(0, 0, wall.width, wall.height);
  }

  void add_side(Side side) {
    const Surface whole = side_of(room_, side);
    const cv::Size2d size = extent(whole);
    if (side == Side::faced && plan_.background)
      return add(whole, read_background(*plan_.background, size), 0.01);

    const Random random = random_.fork(kRoom).fork(static_cast<std::uint64_t>(side));
    const auto fine = side == Side::faced ? around_sheets(size) : std::nullopt;
    const Decoration decoration = decoration_of(side, size, fine, random);
    const cv::Point2d lamp{scene_.lamp.x() - room_.low.x(), scene_.lamp.z() - room_.low.z()};
    const auto paint = [&](const cv::Rect2d& area, double texels_per_m, double light_cell_m) {
      Canvas canvas(area, texels_per_m);
      paint_side(canvas, side, size, decoration, lamp);
      add(part_of(whole, area), canvas.picture, light_cell_m);
    };
    const bool lying = side == Side::floor || side == Side::ceiling;
    paint({0, 0, size.width, size.height}, lying ? 128 : 170, 0.06);
    if (fine) paint(*fine, std::min(kFinestWall, std::sqrt(kPatchTexels / fine->area())), 0.02);
    if (!lying) add_posters(side, whole, decoration, fine);
  }

  void add_posters(Side side, const Surface& wall, const Decoration& decoration,
                   const std::optional<cv::Rect2d>& near) {
    const bool faced = side == Side::faced;
    const cv::Size2d size = extent(wall);
    HangingPlan hanging{.area = {0.1, 0.1, size.width - 0.2, size.height - 0.3}, .preferred = {}};
    hanging.count = static_cast<int>(std::lround(plan_.clutter * (faced ? 30 : 9)));
    if (!faced) hanging.smallest_m = 0.3, hanging.largest_m = 0.8;
    if (near) hanging.preferred = *near;

    std::vector<cv::Rect2d> taken = {decoration.window, decoration.radiator, decoration.door,
                                     decoration.shelf};
    if (faced)
      for (const cv::Rect2d& sheet : sheets_on_wall()) taken.push_back(sheet);
    const Random random = random_.fork(kClutter).fork(static_cast<std::uint64_t>(side));
    std::uint64_t number = 0;
    for (const Hanging& one : hang(hanging, taken, random)) {
      const Canvas canvas = poster(one.size, faced ? 500 : 250, random.fork(kPoster).fork(number++));
      add(turned(wall, one), canvas.picture, 0.04);
    }
  }

  static Surface turned(const Surface& wall, const Hanging& one) {
    const Vector3d x = wall.right.normalized(), y = wall.down.normalized();
    Surface made;
    made.right = one.size.width * (std::cos(one.turn) * x + std::sin(one.turn) * y);
    made.down = one.size.height * (std::cos(one.turn) * y - std::sin(one.turn) * x);
    made.corner = wall.corner + one.middle.x * x + one.middle.y * y - 0.5 * (made.right + made.down);
    return made;
  }

  void add_box() {
    Random random = random_.fork(kBox);
    const double bright = random.uniform();
    const Finish finishes[] = {
        {Material::cardboard, random.next(), paint(0.45, 0.33, 0.2), false},
        {Material::wood, random.next(), paint(0.5, 0.34, 0.18), true},
        {Material::plaster, random.next(), paint(0.3 + 0.3 * bright, 0.45, 0.6 - 0.3 * bright), false}};
    Finish finish = finishes[random.below(3)];
    for (const Surface& side : box_of(plan_, room_)) {
      finish.seed = random.next();
      Canvas canvas({0, 0, side.right.norm(), side.down.norm()}, std::min(800.0, 600 / plan_.box_side_m));
      cover(canvas, finish);
      add(side, canvas.picture, 0.02);
    }
  }

  void add_sheets() {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const PrintedTarget& target = targets_[i];
      Surface sheet = sheets_[i];
      sheet.gloss = plan_.gloss;
      Texture texture = make_texture(printed(target.picture), light_.over(sheet, 0.005));
      while (texture.width() > kWidestSheet) texture.levels.erase(texture.levels.begin());
      sheet.texture = std::make_shared<Texture>(std::move(texture));
      scene_.targets.push_back({.printed = target, .id = id_of(i), .surface = scene_.surfaces.size()});
      scene_.surfaces.push_back(std::move(sheet));
    }
  }

  std::string id_of(std::size_t index) const {
    const auto same = [&](const PrintedTarget& other) { return other.name == targets_[index].name; };
    const auto end = targets_.begin() + static_cast<std::ptrdiff_t>(index);
    const auto before = std::count_if(targets_.begin(), end, same);
    return before == 0 ? targets_[index].name : fmt::format("{}-{}", targets_[index].name, before + 1);
  }

  void add_occluders() {
    for (std::size_t i = 0; i < targets_.size(); ++i)
      for (Surface& passer : passers_before(sheets_[i], targets_[i].size_m, plan_.occluders_hz, light_,
                                            random_.fork(kOccluder).fork(i))) {
        scene_.occluders.push_back(scene_.surfaces.size());
        scene_.surfaces.push_back(std::move(passer));
      }
  }

  const ScenePlan& plan_;
  const std::vector<PrintedTarget>& targets_;
  Random random_;
  Scene scene_;
  Room room_;
  std::vector<Surface> sheets_;
  Light light_;
};

}  // namespace

std::optional<double> Surface::hit(const Vector3d& eye, const Vector3d& ray, double t) const {
  const Vector3d normal = right.cross(down);
  const double along = normal.dot(ray);
  if (along <= 1e-12) return {};
  const double depth = normal.dot(corner_at(t) - eye) / along;
  const Vector3d on = eye + depth * ray - corner_at(t);
  const double u = on.dot(right) / right.squaredNorm(), v = on.dot(down) / down.squaredNorm();
  if (depth <= 0 || u < 0 || u > 1 || v < 0 || v > 1) return {};
  return depth;
}

void check_scene(const ScenePlan& plan) {
  check_range("scene: spacing_m", plan.spacing_m, 0.01, 5);
  check_range("scene: box_side_m", plan.box_side_m, 0.01, 1.5);
  check_range("scene: clutter", plan.clutter, 0, 1);
  check_range("scene: light_gradient", plan.light_gradient, 0, 1);
  check_range("scene: shadows", plan.shadows, 0, 1);
  check_range("scene: gloss", plan.gloss, 0, 100);
  check_range("scene: occluders_hz", plan.occluders_hz, 0, 5);
}

Scene build_scene(const ScenePlan& plan, const std::vector<PrintedTarget>& targets, std::uint64_t seed) {
  check_scene(plan);
  return Builder(plan, targets, seed).build();
}

}  // namespace relock::simulator
