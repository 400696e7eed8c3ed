#include "sequences/simulator/clutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sequences/simulator/grain.h"

namespace relock::simulator {
namespace {

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

// Half of what is printed is black on white, as fiducials are.
cv::Scalar ink(Random& random) {
  if (random.chance(0.55)) return paint(0.045);
  const double red = between(random, 0.03, 0.6), green = between(random, 0.03, 0.4),
               blue = between(random, 0.03, 0.6);
  return paint(red, green, blue);
}

void circles(Canvas& canvas, Random& random) {
  const double side = std::min(canvas.area.width, canvas.area.height);
  for (int i = 0; i < 12; ++i) {
    const cv::Point2d middle{canvas.area.width * random.uniform(), canvas.area.height * random.uniform()};
    const double radius = side * between(random, 0.05, 0.25);
    const cv::Scalar dark = ink(random);
    if (random.chance(0.5)) {
      canvas.disc(middle, radius, dark);
    } else {
      canvas.circle(middle, radius, radius * between(random, 0.1, 0.4), dark);
    }
  }
}

void target(Canvas& canvas, Random& random) {
  const double radius = 0.46 * std::min(canvas.area.width, canvas.area.height);
  const cv::Point2d middle{canvas.area.width / 2, canvas.area.height / 2};
  const cv::Scalar dark = ink(random);
  const auto rings = 3 + static_cast<int>(random.below(6));
  for (int i = 0; i < rings; ++i)
    canvas.disc(middle, radius * (rings - i) / rings, i % 2 == 0 ? dark : paint(0.8));
}

void blinds(Canvas& canvas, Random& random) {
  const cv::Scalar dark = ink(random);
  const double period = canvas.area.height / between(random, 6, 18), share = between(random, 0.3, 0.7);
  for (double y = 0.3 * period; y < canvas.area.height; y += period)
    canvas.fill({0, y, canvas.area.width, period * share}, dark);
}

void grid(Canvas& canvas, Random& random) {
  const cv::Scalar dark = ink(random);
  const double cell = std::min(canvas.area.width, canvas.area.height) / between(random, 4, 12);
  const double width = cell * between(random, 0.06, 0.3);
  for (double x = cell / 2; x < canvas.area.width; x += cell)
    canvas.fill({x, 0, width, canvas.area.height}, dark);
  for (double y = cell / 2; y < canvas.area.height; y += cell)
    canvas.fill({0, y, canvas.area.width, width}, dark);
}

void text(Canvas& canvas, Random& random) {
  const cv::Scalar dark = ink(random);
  double height = canvas.area.height * between(random, 0.07, 0.12);  // a heading, then smaller
  for (double y = 2 * height; y < canvas.area.height - 0.01; y += 2.2 * height) {
    std::string line;
    while (static_cast<double>(line.size()) * height < 1.1 * canvas.area.width) {
      const char first = random.chance(0.2) ? 'A' : 'a';
      line += random.chance(0.17) ? ' ' : static_cast<char>(first + static_cast<int>(random.below(26)));
    }
    canvas.write(line, {0.06 * canvas.area.width, y}, height, dark);
    height = std::min(height, canvas.area.height * 0.035);
  }
  canvas.fill({0.93 * canvas.area.width, 0, 0.07 * canvas.area.width, canvas.area.height}, paint(0.8));
}

void checkerboard(Canvas& canvas, Random& random) {
  const cv::Scalar dark = ink(random);
  const auto columns = 4 + static_cast<int>(random.below(6));
  const double cell = 0.9 * canvas.area.width / columns, start = 0.05 * canvas.area.width;
  const int rows = static_cast<int>(0.92 * canvas.area.height / cell);
  for (int j = 0; j < rows; ++j)
    for (int i = j % 2; i < columns; i += 2)
      canvas.fill({start + i * cell, start + j * cell, cell, cell}, dark);
}

void crosses(Canvas& canvas, Random& random) {
  const double side = std::min(canvas.area.width, canvas.area.height);
  for (int i = 0; i < 9; ++i) {
    const cv::Point2d middle{canvas.area.width * (0.18 + 0.32 * (i % 3)),
                             canvas.area.height * (0.18 + 0.32 * (i / 3))};
    const double turn = M_PI * random.uniform(), arm = side * between(random, 0.06, 0.14);
    const double width = arm * between(random, 0.2, 0.7);
    const cv::Scalar dark = ink(random);
    for (const double angle : {turn, turn + M_PI / 2}) {
      const cv::Point2d half{arm * std::cos(angle), arm * std::sin(angle)};
      canvas.line(middle - half, middle + half, width, dark);
    }
  }
}

void landscape(Canvas& canvas, Random& random) {
  const Grain ridges{
      .seed = random.next(), .coarsest_m = canvas.area.width / 2, .finest_m = 0.002, .fall = 0.6};
  const cv::Mat height = grain_over(ridges, canvas.area, canvas.picture.size());
  const double warm = random.uniform();
  for (int y = 0; y < canvas.picture.rows; ++y)
    for (int x = 0; x < canvas.picture.cols; ++x) {
      const double down = (y + 0.5) / canvas.picture.rows + 0.1 * static_cast<double>(height.at<float>(y, x));
      cv::Vec3d colour{200 - 60 * down, 190 - 60 * down + 20 * warm, 170 + 60 * warm - 60 * down};
      if (down > 0.45) colour = {120 - 50 * down, 130 - 70 * down, 120 - 60 * down};
      if (down > 0.65) colour = {60 - 20 * down, 110 - 50 * down, 90 + 60 * warm - 70 * down};
      for (int c = 0; c < 3; ++c) canvas.picture.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(colour[c]);
    }
}

Canvas paper(const cv::Size2d& size, double texels_per_m, Random& random) {
  Canvas canvas({0, 0, size.width, size.height}, texels_per_m);
  canvas.picture.setTo(random.chance(0.75) ? paint(0.84, 0.84, 0.82) : paint(0.78, 0.7, 0.45));
  return canvas;
}

constexpr std::array kPrints = {circles, target,       blinds,  grid,
                                text,    checkerboard, crosses, landscape};  // as of Print

}  // namespace

Canvas poster(const cv::Size2d& size, double texels_per_m, Random random) {
  Canvas canvas = paper(size, texels_per_m, random);
  kPrints[random.below(kPrints.size())](canvas, random);
  return canvas;
}

Canvas poster(Print print, const cv::Size2d& size, double texels_per_m, Random random) {
  Canvas canvas = paper(size, texels_per_m, random);
  kPrints[static_cast<std::size_t>(print)](canvas, random);
  return canvas;
}

cv::Rect2d Hanging::bounds() const {
  const double c = std::abs(std::cos(turn)), s = std::abs(std::sin(turn));
  const double width = size.width * c + size.height * s, height = size.width * s + size.height * c;
  return {middle.x - width / 2, middle.y - height / 2, width, height};
}

std::vector<Hanging> hang(const HangingPlan& plan, std::vector<cv::Rect2d> taken, Random random) {
  constexpr double kApart = 0.02;
  std::vector<Hanging> found;
  for (int tries = 0; static_cast<int>(found.size()) < plan.count && tries < 40 * plan.count; ++tries) {
    const bool near = plan.preferred.area() > 0 && tries % 2 == 0;
    const cv::Rect2d& in = near ? plan.preferred : plan.area;
    Hanging one;
    one.middle = {in.x + in.width * random.uniform(), in.y + in.height * random.uniform()};
    one.size.width = between(random, plan.smallest_m, plan.largest_m);
    one.size.height = one.size.width * between(random, 0.75, 1.35);
    if (random.chance(0.4)) one.turn = between(random, -0.15, 0.15);
    cv::Rect2d bounds = one.bounds();
    if ((bounds & plan.area).area() < bounds.area() - 1e-9) continue;
    bounds -= cv::Point2d(kApart, kApart);
    bounds += cv::Size2d(2 * kApart, 2 * kApart);
    if (std::any_of(taken.begin(), taken.end(), [&](const cv::Rect2d& t) { return (t & bounds).area() > 0; }))
      continue;
    taken.push_back(bounds);
    found.push_back(one);
  }
  return found;
}

}  // namespace relock::simulator
