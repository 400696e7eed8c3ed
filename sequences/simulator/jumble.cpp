#include "sequences/simulator/jumble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "sequences/simulator/clutter.h"
#include "sequences/simulator/grain.h"
#include "sequences/simulator/material.h"
#include "sequences/simulator/painting.h"
#include "sequences/simulator/range.h"

namespace relock::simulator {
namespace {

using std::numbers::pi;

constexpr Range kRadius_px{6, 110};
constexpr double kBeyond_px = 60;      // things lie up to here outside the picture, for what a blur brings in
constexpr double kPrinted_px_m = 300;  // px of a picture that a metre of a poster or a wall has

/// Where a thing goes. `random` is the thing's own. No call draws two of its arguments: their order is not defined.
struct Spot {
  Canvas& canvas;
  cv::Point2d middle;
  double radius;
  Random random;

  double between(double low, double high) { return drawn(random, {low, high}); }
  /// A direction without a sign.
  double turn() { return pi * random.uniform(); }
  cv::Scalar grey(double low = 0, double high = 255) { return cv::Scalar(between(low, high)); }
  /// `along` and `across` of a direction, from the middle.
  cv::Point2d at(double turn, double along, double across) const {
    const double c = std::cos(turn), s = std::sin(turn);
    return middle + cv::Point2d(along * c - across * s, along * s + across * c);
  }
  /// A rectangle about a place given by `along` and `across`.
  void bar(double turn, double along, double across, double length, double width, const cv::Scalar& colour) {
    canvas.fill(
        {at(turn, along - length / 2, across - width / 2), at(turn, along + length / 2, across - width / 2),
         at(turn, along + length / 2, across + width / 2), at(turn, along - length / 2, across + width / 2)},
        colour);
  }
};

void blob(Spot& spot) {
  const double turn = spot.turn(), flat = spot.between(0.3, 1);
  spot.canvas.ellipse(spot.middle, {spot.radius, spot.radius * flat}, turn, spot.grey());
}

void hoop(Spot& spot) {
  // Drawn as two, so that something else is inside.
  const double turn = spot.turn(), flat = spot.between(0.3, 1);
  const double width = std::min(spot.between(1, 8), 0.45 * spot.radius * flat);
  spot.canvas.ellipse(spot.middle, {spot.radius, spot.radius * flat}, turn, spot.grey());
  spot.canvas.ellipse(spot.middle, {spot.radius - width, spot.radius * flat - width}, turn, spot.grey());
}

void slab(Spot& spot) {
  const double turn = spot.turn(), width = spot.radius * spot.between(0.2, 2);
  spot.bar(turn, 0, 0, 2 * spot.radius, width, spot.grey());
}

void shard(Spot& spot) {
  std::vector<cv::Point2d> corners;
  double turn = 2 * spot.turn();
  const auto count = 3 + spot.random.below(2);
  for (std::uint64_t i = 0; i < count; ++i) {
    corners.push_back(spot.at(turn, spot.radius * spot.between(0.5, 1.3), 0));
    turn += spot.between(1.2, 2);
  }
  spot.canvas.fill(corners, spot.grey());
}

void rod(Spot& spot) {
  const double turn = spot.turn(), length = spot.between(20, 280), width = spot.between(0.5, 7);
  spot.bar(turn, 0, 0, length, width, spot.grey());
}

void grating(Spot& spot) {
  const auto bars = 3 + static_cast<int>(spot.random.below(14));
  const double turn = spot.turn(), period = spot.between(3, 20), length = spot.between(10, 80);
  const cv::Scalar one = spot.grey(), other = spot.grey();
  for (int i = 0; i < bars; ++i) {
    const double apart = period * (spot.random.chance(0.75) ? 1 : 0.9);
    spot.bar(turn, 0, (i - bars / 2.0) * apart, length, period * spot.between(0.3, 0.6),
             i % 2 == 0 ? one : other);
  }
}

void writing(Spot& spot) {
  constexpr std::array words = {"STOP 42", "hello world", "Ring 8",  "QR|||",
                                "0O0O0",   "EXIT",        "(((o)))", "OOO"};
  const std::size_t word = spot.random.below(words.size());
  const double height = spot.between(6, 42);
  spot.canvas.write(words[word], spot.middle, height, spot.grey());
}

void checks(Spot& spot) {
  const auto cells = 2 + static_cast<int>(spot.random.below(6));
  const double turn = spot.random.chance(0.5) ? 0 : spot.turn(), cell = spot.between(4, 18);
  const cv::Scalar one = spot.grey(), other = spot.grey();
  for (int i = 0; i < cells * cells; ++i)
    spot.bar(turn, (i % cells - cells / 2.0) * cell, (i / cells - cells / 2.0) * cell, cell, cell,
             (i % cells + i / cells) % 2 == 0 ? one : other);
}

/// Rings as a marker has, dark and bright in turn and now and then seen askew. Each is 0.45 to 0.93 as large as the
/// one around it: by chance, no more than that, could these be the radii of a code.
void ring_target(Spot& spot) {
  const double turn = spot.turn(), flat = spot.random.chance(0.5) ? 1 : spot.between(0.5, 1);
  cv::Scalar dark = spot.grey(0, 60), bright = spot.grey(150, 255);
  if (spot.random.chance(0.2)) std::swap(dark, bright);
  const auto disc = [&](double radius, const cv::Scalar& colour) {
    spot.canvas.ellipse(spot.middle, {radius, radius * flat}, turn, colour);
  };
  disc(spot.radius * spot.between(1.1, 1.5), dark);
  int count = 0;
  for (double radius = spot.radius; radius > 2; radius *= spot.between(0.45, 0.93))
    disc(radius, count++ % 2 == 0 ? bright : dark);
}

/// Lays a coloured picture about the spot, of so many px, turned.
void lay(Spot& spot, const cv::Mat& picture, cv::Size2d size, double turn) {
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  const double scale = spot.canvas.texels_per_m();
  const cv::Point2d reach(
      size.width / 2 * std::abs(std::cos(turn)) + size.height / 2 * std::abs(std::sin(turn)),
      size.width / 2 * std::abs(std::sin(turn)) + size.height / 2 * std::abs(std::cos(turn)));
  const cv::Point2d first = spot.canvas.pixel(spot.middle - reach),
                    last = spot.canvas.pixel(spot.middle + reach);
  const cv::Rect where = cv::Rect(cv::Point(cvFloor(first.x), cvFloor(first.y)),
                                  cv::Point(cvCeil(last.x) + 1, cvCeil(last.y) + 1)) &
                         cv::Rect({0, 0}, spot.canvas.picture.size());
  if (where.empty()) return;
  const cv::Point2d middle = spot.canvas.pixel(spot.middle) - cv::Point2d(where.tl());
  const double across = grey.cols / (size.width * scale), down = grey.rows / (size.height * scale);
  const double c = std::cos(turn), s = std::sin(turn);
  const cv::Matx23d to_sheet(across * c, across * s,
                             grey.cols / 2.0 - 0.5 - across * (c * middle.x + s * middle.y), -down * s,
                             down * c, grey.rows / 2.0 - 0.5 - down * (c * middle.y - s * middle.x));
  cv::Mat laid = spot.canvas.picture(where);
  cv::warpAffine(grey, laid, to_sheet, where.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_TRANSPARENT);
}

double askew(Spot& spot) { return spot.random.chance(0.5) ? spot.between(-0.2, 0.2) : 2 * spot.turn(); }

void print(Spot& spot) {
  // Not Print::target: even rings may be a code.
  constexpr std::array prints = {Print::circles, Print::blinds,       Print::grid,   Print::text,
                                 Print::text,    Print::checkerboard, Print::crosses};
  const double radius = std::max(spot.radius, 25.0);
  const cv::Size2d size(2 * radius, 2 * radius * spot.between(0.7, 1.35));
  const Print kind = prints[spot.random.below(prints.size())];
  const Canvas sheet = poster(kind, {size.width / kPrinted_px_m, size.height / kPrinted_px_m},
                              kPrinted_px_m * spot.canvas.texels_per_m(), spot.random.fork(1));
  lay(spot, sheet.picture, size, askew(spot));
}

/// A piece of a wall, or of a picture of a landscape: soft, so half as many texels do.
void piece(Spot& spot) {
  const double radius = std::max(spot.radius, 25.0);
  const cv::Size2d size(2 * radius, 2 * radius * spot.between(0.5, 1.2));
  const cv::Size2d size_m(size.width / kPrinted_px_m, size.height / kPrinted_px_m);
  if (spot.random.chance(0.4)) {
    const Canvas view = poster(Print::landscape, size_m, kPrinted_px_m, spot.random.fork(1));
    lay(spot, view.picture, size, askew(spot));
    return;
  }
  Canvas wall({0, 0, size_m.width, size_m.height}, kPrinted_px_m);
  constexpr std::array materials = {Material::wallpaper, Material::brick, Material::concrete,
                                    Material::wood,      Material::tiles, Material::cardboard};
  const Finish finish{.material = materials[spot.random.below(materials.size())],
                      .seed = spot.random.next(),
                      .colour = paint(spot.between(0.1, 0.8)),
                      .upright = spot.random.chance(0.5)};
  cover(wall, finish);
  lay(spot, wall.picture, size, askew(spot));
}

/// The ground that all lies on.
cv::Mat1b ground(Size picture, const cv::Rect& area, int texels_per_px, Random random) {
  const double base = drawn(random, {60, 190}), slope = drawn(random, {0, 50}),
               turn = 2 * pi * random.uniform();
  const double strength = drawn(random, {2, 28});
  const Grain grain{.seed = random.next(),
                    .coarsest_m = 128,
                    .finest_m = 2,
                    .fall = drawn(random, {0.55, 1.1}),
                    .stretch = random.chance(0.7) ? 1 : drawn(random, {0.3, 3})};
  const cv::Mat1f rough = grain_over(grain, area, area.size());
  const double side = std::max(picture.width, picture.height);
  const double right = slope * std::cos(turn) * 2 / side, down = slope * std::sin(turn) * 2 / side;
  cv::Mat1b coarse(area.size());
  for (int y = 0; y < coarse.rows; ++y)
    for (int x = 0; x < coarse.cols; ++x)
      coarse(y, x) = cv::saturate_cast<std::uint8_t>(base + right * (area.x + x - picture.width / 2.0) +
                                                     down * (area.y + y - picture.height / 2.0) +
                                                     strength * static_cast<double>(rough(y, x)));
  cv::Mat1b fine;
  cv::resize(coarse, fine, area.size() * texels_per_px, 0, 0, cv::INTER_LINEAR_EXACT);
  return fine;
}

}  // namespace

cv::Mat1b jumble(Size picture, const cv::Rect& area, int texels_per_px, const Random& random) {
  constexpr std::array kinds = {blob,    hoop,   slab,        shard,       rod,   grating,
                                writing, checks, ring_target, ring_target, print, piece};
  const cv::Mat1b made = ground(picture, area, texels_per_px, random.fork(1));
  Canvas canvas(area, made);
  Random counted = random.fork(2);
  const double share = std::sqrt(picture.width * picture.height / (640.0 * 480.0));
  const auto count = static_cast<std::uint64_t>(share * drawn(counted, {20, 160}));
  for (std::uint64_t i = 0; i < count; ++i) {
    Random own = random.fork(3).fork(i);
    const cv::Point2d middle{
        drawn(own, {-kBeyond_px, picture.width + kBeyond_px}),
        drawn(own, {-kBeyond_px, picture.height + kBeyond_px})};  // braces: in this order
    const double radius = std::exp(drawn(own, {std::log(kRadius_px.low), std::log(kRadius_px.high)}));
    const auto draw = kinds[own.below(kinds.size())];
    Spot spot{canvas, middle, radius, own};
    draw(spot);
  }
  return made;
}

}  // namespace relock::simulator
