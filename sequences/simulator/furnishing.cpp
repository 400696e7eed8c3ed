#include <algorithm>
#include <array>
#include <cmath>

#include "sequences/simulator/grain.h"
#include "sequences/simulator/room.h"

namespace relock::simulator {
namespace {

cv::Rect2d shrunk(const cv::Rect2d& r, double by) {
  return {r.x + by, r.y + by, r.width - 2 * by, r.height - 2 * by};
}

// Dyes are seldom pure: every colour has half of a common grey.
cv::Scalar some_colour(Random& random, double darkest, double brightest) {
  const double grey = random.uniform();
  const auto share = [&] { return darkest + (brightest - darkest) * 0.5 * (grey + random.uniform()); };
  const double red = share(), green = share(), blue = share();
  return paint(red, green, blue);
}

// Walls are plaster, paper, brick, concrete or boards; the colours are reflectances as measured of such.
Finish wall_finish(Random& random) {
  Finish finish{.seed = random.next(), .colour = {}};
  const double warm = random.uniform(), bright = random.uniform();
  switch (random.below(6)) {
    case 0:
      finish.material = Material::wallpaper;
      finish.colour = paint(0.62 + 0.1 * bright, 0.55 + 0.12 * warm, 0.45 + 0.15 * bright);
      break;
    case 1:
      finish.material = Material::brick;
      finish.colour = paint(0.42 + 0.12 * bright, 0.17 + 0.1 * warm, 0.10 + 0.06 * warm);
      break;
    case 2:
      finish.material = Material::concrete;
      finish.colour = paint(0.42 + 0.1 * bright);
      break;
    case 3:
      finish.material = Material::wood;
      finish.upright = true;
      finish.colour = paint(0.48 + 0.15 * bright, 0.30 + 0.1 * bright, 0.15 + 0.08 * warm);
      break;
    default:
      finish.colour = paint(0.62 + 0.18 * bright, 0.58 + 0.2 * bright - 0.06 * warm, 0.5 + 0.25 * warm);
  }
  return finish;
}

Finish finish_of(Side side, Random& random) {
  const double bright = random.uniform();
  if (side == Side::ceiling) return {.seed = random.next(), .colour = paint(0.78)};
  if (side != Side::floor) return wall_finish(random);
  if (random.chance(0.5))
    return {Material::wood, random.next(), paint(0.40 + 0.1 * bright, 0.24 + 0.08 * bright, 0.12), false};
  return {Material::tiles, random.next(), paint(0.45 + 0.1 * bright, 0.43 + 0.1 * bright, 0.4), false};
}

void paint_window(Canvas& canvas, const cv::Rect2d& window, std::uint64_t seed) {
  canvas.fill({window.x - 0.05, window.y + window.height, window.width + 0.1, 0.05}, paint(0.55));
  canvas.fill(window, paint(0.78, 0.77, 0.74));
  const cv::Rect2d glass = shrunk(window, 0.06);
  canvas.fill(glass, paint(0.62, 0.72, 0.85));
  const double hills = glass.y + 0.6 * glass.height;
  canvas.fill({glass.x, hills, glass.width, glass.y + glass.height - hills}, paint(0.16, 0.24, 0.10));
  Random trees(seed);
  for (int i = 0; i < 60; ++i) {
    const double radius = 0.03 + 0.05 * trees.uniform(), green = 0.05 + 0.2 * trees.uniform();
    const double x = glass.x + radius + (glass.width - 2 * radius) * trees.uniform();
    const double y = hills + (glass.y + glass.height - hills - 0.08) * trees.uniform();
    canvas.disc({x, y}, radius, paint(0.7 * green, green, 0.35 * green));
  }
  canvas.fill({window.x + window.width / 2 - 0.03, window.y, 0.06, window.height}, paint(0.75));
  // Blinds, down to somewhere, every slat with its shadow.
  const double down = glass.height * (0.35 + 0.6 * number_of_cell(seed, 0, 1));
  const double slat = 0.035 + 0.02 * number_of_cell(seed, 0, 2);
  for (double y = glass.y; y + slat < glass.y + down; y += slat) {
    canvas.fill({glass.x, y, glass.width, 0.7 * slat}, paint(0.80, 0.78, 0.72));
    canvas.fill({glass.x, y + 0.6 * slat, glass.width, 0.1 * slat}, paint(0.45, 0.43, 0.40));
  }
}

void paint_radiator(Canvas& canvas, const cv::Rect2d& body) {
  canvas.fill(body, paint(0.42));
  for (double x = body.x; x + 0.045 < body.x + body.width; x += 0.06)
    canvas.fill({x, body.y - 0.01, 0.045, body.height + 0.02}, paint(0.80));
}

void paint_door(Canvas& canvas, const cv::Rect2d& door, std::uint64_t seed) {
  const double bright = number_of_cell(seed, 1, 1);
  canvas.fill(shrunk(door, -0.07), paint(0.72));
  canvas.fill(door, paint(0.36 + 0.2 * bright, 0.22 + 0.2 * bright, 0.11 + 0.2 * bright));
  for (int i = 0; i < 4; ++i) {
    const double width = door.width / 2 - 0.14, height = i / 2 == 0 ? 0.75 : 0.85;
    const cv::Rect2d panel{door.x + 0.1 + i % 2 * (width + 0.08), door.y + (i / 2 == 0 ? 0.12 : 1.02), width,
                           height};
    canvas.fill(panel, paint(0.20 + 0.1 * bright, 0.12 + 0.1 * bright, 0.06 + 0.1 * bright));
    canvas.fill(shrunk(panel, 0.02), paint(0.40 + 0.2 * bright, 0.25 + 0.2 * bright, 0.13 + 0.2 * bright));
  }
  canvas.disc({door.x + door.width - 0.06, door.y + 1.0}, 0.028, paint(0.6, 0.52, 0.3));
}

void paint_books(Canvas& canvas, const cv::Rect2d& board, Random& random) {
  double x = board.x + 0.01;
  while (true) {
    const double width = 0.018 + 0.04 * random.uniform();
    const double height = board.height * (0.55 + 0.38 * random.uniform());
    if (x + width > board.x + board.width - 0.01) return;
    const cv::Rect2d back{x, board.y + board.height - height, width, height};
    canvas.fill(back, some_colour(random, 0.05, 0.6));
    canvas.fill({x, back.y, 0.003, height}, paint(0.05));
    const cv::Scalar label = some_colour(random, 0.5, 0.8);
    if (random.chance(0.6))
      canvas.fill({x + 0.004, back.y + 0.15 * height, width - 0.008, 0.2 * height}, label);
    x += width + (random.chance(0.08) ? 0.1 * random.uniform() : 0.0);
  }
}

void paint_shelf(Canvas& canvas, const cv::Rect2d& shelf, std::uint64_t seed) {
  Random random(seed);
  canvas.fill(shelf, paint(0.5, 0.36, 0.2));
  const int boards = std::max(1, static_cast<int>(shelf.height / 0.34));
  const double step = shelf.height / boards;
  for (int i = 0; i < boards; ++i) {
    const cv::Rect2d open{shelf.x + 0.025, shelf.y + i * step + 0.025, shelf.width - 0.05, step - 0.035};
    canvas.fill(open, paint(0.13, 0.09, 0.05));
    canvas.fill({open.x, open.y, open.width, 0.05}, paint(0.07, 0.05, 0.03));  // the board's shadow
    paint_books(canvas, open, random);
  }
}

void paint_rug(Canvas& canvas, const cv::Size2d& size, std::uint64_t seed) {
  Random random(seed);
  cv::Rect2d rug{size.width * (0.25 + 0.1 * random.uniform()), size.height * 0.3, 2.2, 1.6};
  for (int i = 0; i < 7 && rug.height > 0.1; ++i, rug = shrunk(rug, 0.05 + 0.1 * random.uniform()))
    canvas.fill(rug, some_colour(random, 0.06, 0.5));
}

}  // namespace

Decoration decoration_of(Side side, const cv::Size2d& size, const std::optional<cv::Rect2d>& free,
                         Random random) {
  Decoration made{
      .finish = finish_of(side, random), .window = {}, .radiator = {}, .door = {}, .shelf = {}, .seed = 0};
  made.seed = random.next();
  const auto keep = [&](const cv::Rect2d& thing) {
    return free && (*free & thing).area() > 0 ? cv::Rect2d{} : thing;
  };
  const double right = size.width, low = size.height;
  switch (side) {
    case Side::faced:
      made.window = keep({0.25 + 0.2 * random.uniform(), 0.5, 1.1, 1.3});
      made.shelf = keep({right - 1.35, low - 2.1, 1.05, 2.0});
      break;
    case Side::left:
      made.window = keep({right / 2 - 1, 0.45, 1.7, 1.4});
      break;
    case Side::right:
      made.shelf = keep({right / 2 - 0.9, low - 2.2, 2.2, 2.1});
      break;
    case Side::behind:
      made.door = keep({right / 2 + 0.3 * random.uniform(), low - 2.05, 0.9, 2.05});
      break;
    case Side::floor:
    case Side::ceiling:
      break;
  }
  const cv::Rect2d& window = made.window;
  if (window.area() > 0) made.radiator = keep({window.x + 0.1, low - 0.75, window.width - 0.2, 0.6});
  return made;
}

void paint_side(Canvas& canvas, Side side, const cv::Size2d& size, const Decoration& decoration,
                const cv::Point2d& lamp) {
  cover(canvas, decoration.finish);
  if (side == Side::floor) return paint_rug(canvas, size, decoration.seed);
  if (side == Side::ceiling) {
    canvas.disc(lamp, 0.2, paint(0.6));
    return canvas.disc(lamp, 0.18, paint(1.0));
  }
  canvas.fill({0, size.height - 0.09, size.width, 0.09}, paint(0.66, 0.64, 0.6));
  canvas.fill({0, size.height - 0.095, size.width, 0.008}, paint(0.25));
  if (decoration.window.area() > 0) {
    paint_window(canvas, decoration.window, decoration.seed);
    paint_radiator(canvas, decoration.radiator);
  }
  if (decoration.door.area() > 0) paint_door(canvas, decoration.door, decoration.seed);
  if (decoration.shelf.area() > 0) paint_shelf(canvas, decoration.shelf, decoration.seed);
}

}  // namespace relock::simulator
