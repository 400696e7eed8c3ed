#include "cli/conformance/scene.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace relock {
namespace {

/// Smooth noise: random colours on a lattice, blended between its points.
class Blobs {
 public:
  Blobs(int columns, int rows, double least, double most, Random random)
      : columns_(columns), colours_(static_cast<std::size_t>(columns * rows)) {
    for (Colour& colour : colours_)
      for (double& level : colour) level = least + (most - least) * random.uniform();
  }

  /// In lattice steps, inside the lattice.
  Colour at(double x, double y) const {
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const double across = smooth(x - left), down = smooth(y - top);
    Colour colour;
    for (std::size_t c = 0; c < 3; ++c)
      colour[c] = std::lerp(std::lerp(point(left, top)[c], point(left + 1, top)[c], across),
                            std::lerp(point(left, top + 1)[c], point(left + 1, top + 1)[c], across), down);
    return colour;
  }

 private:
  static double smooth(double t) { return t * t * (3 - 2 * t); }
  const Colour& point(int column, int row) const {
    return colours_[static_cast<std::size_t>(row * columns_ + column)];
  }

  int columns_;
  std::vector<Colour> colours_;
};

std::uint8_t level(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Picture wall_of(Size size, std::uint64_t seed) {
  constexpr double kGrainPx = 6;
  const auto steps = [](int px) { return static_cast<int>(px / kGrainPx) + 2; };
  const Blobs blobs(steps(size.width), steps(size.height), 70, 130, Random(seed));
  Picture wall{size, PixelFormat::bgr8, {}};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (const double value : blobs.at(x / kGrainPx, y / kGrainPx)) wall.bytes.push_back(level(value));
  return wall;
}

/// The middles of the fine squares into which a pixel is cut.
constexpr std::array<double, 4> kParts{-0.375, -0.125, 0.125, 0.375};

void draw_pixel(std::uint8_t* pixel, int x, int y, const Box& box, const Look& look) {
  Colour sum{};
  for (const double dy : kParts)
    for (const double dx : kParts) {
      const double u = (x + dx - box.x) / box.width, v = (y + dy - box.y) / box.height;
      const bool inside = u >= 0 && u < 1 && v >= 0 && v < 1;
      const Colour colour = inside ? look(u, v) : Colour{1.0 * pixel[0], 1.0 * pixel[1], 1.0 * pixel[2]};
      for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
    }
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = level(sum[c] / (kParts.size() * kParts.size()));
}

Box moved(const Box& box, Vec2 by) { return {box.x + by.x, box.y + by.y, box.width, box.height}; }

Box scaled(const Box& box, double factor) {
  const double width = factor * box.width, height = factor * box.height;
  return {box.x + (box.width - width) / 2, box.y + (box.height - height) / 2, width, height};
}

constexpr Vec2 kPlainly{2, 0.7};  // px a frame

}  // namespace

Look textured(std::uint64_t seed) {
  constexpr int kBlobs = 5;
  return [blobs = Blobs(kBlobs + 2, kBlobs + 2, 10, 250, Random(seed))](double u, double v) {
    return blobs.at(kBlobs * u, kBlobs * v);
  };
}

Look printed(const MarkerCells& print) {
  return [print](double u, double v) {
    const auto column = static_cast<std::size_t>(u * print.side),
               row = static_cast<std::size_t>(v * print.side);
    const double grey = 25 + 210 * print.grey[row * static_cast<std::size_t>(print.side) + column] / 255.0;
    return Colour{grey, grey, grey};
  };
}

Scene::Scene(Size size, Look target, std::uint64_t seed)
    : wall_(wall_of(size, seed)), target_(std::move(target)) {}

Picture Scene::with_target(const Box& box) const {
  Picture picture = wall_;
  const Box seen = intersect(box, picture_box(size()));
  if (seen.area() <= 0) return picture;
  const int left = static_cast<int>(std::floor(seen.x + 0.5)),
            top = static_cast<int>(std::floor(seen.y + 0.5));
  for (int y = top; y < size().height && y - 0.5 < seen.bottom(); ++y)
    for (int x = left; x < size().width && x - 0.5 < seen.right(); ++x)
      draw_pixel(
          &picture.bytes[static_cast<std::size_t>(y) * picture.row_bytes() + 3 * static_cast<std::size_t>(x)],
          x, y, box, target_);
  return picture;
}

Picture flat(Size size, std::uint8_t grey) {
  Picture picture{size, PixelFormat::bgr8, {}};
  picture.bytes.assign(picture.row_bytes() * static_cast<std::size_t>(size.height), grey);
  return picture;
}

Picture noise(Size size, std::uint64_t seed) {
  Picture picture = flat(size, 0);
  Random random(seed);
  for (std::uint8_t& byte : picture.bytes) byte = static_cast<std::uint8_t>(random.below(256));
  return picture;
}

Picture grey_of(const Picture& picture) {
  if (picture.format == PixelFormat::gray8) return picture;
  Picture grey{picture.size, PixelFormat::gray8, {}};
  for (std::size_t i = 0; i + 2 < picture.bytes.size(); i += 3)
    grey.bytes.push_back(level((picture.bytes[i] + picture.bytes[i + 1] + picture.bytes[i + 2]) / 3.0));
  return grey;
}

void Film::add(Picture picture, std::string what, FrameIndex lost, Duration pause) {
  Shot shot{std::move(picture), std::move(what)};
  if (!shots.empty()) {
    const FrameIndex steps = lost + 1;
    shot.index = shots.back().index + steps;
    shot.captured = shots.back().captured + steps * period_of(30) + pause;
  }
  shots.push_back(std::move(shot));
}

Film moving(const Scene& scene, const Box& start, Vec2 velocity, int frames) {
  Film film{start, {}};
  for (int i = 0; i <= frames; ++i)
    film.add(scene.with_target(moved(start, static_cast<double>(i) * velocity)));
  return film;
}

Film leaving(const Scene& scene, const Box& start) {
  constexpr double kStepPx = 8;
  Film film{start, {}};
  Box box = start;
  for (; box.right() > -0.5; box.x -= kStepPx)
    film.add(scene.with_target(box), "the target leaves the picture");
  for (int i = 0; i < 4; ++i) film.add(scene.wall(), "the target has left the picture");
  for (int i = 0; i < 4; ++i)
    film.add(scene.with_target(box = moved(box, {kStepPx, 0})), "the target comes back");
  return film;
}

Film shrinking(const Scene& scene, const Box& start) {
  Film film{start, {}};
  double factor = 1;
  for (int i = 0; i < 12; ++i, factor *= 0.75)
    film.add(scene.with_target(scaled(start, factor)), "the target shrinks");
  for (int i = 0; i < 2; ++i) film.add(scene.wall(), "the target has shrunk to nothing");
  return film;
}

Film vanishing(const Scene& scene, const Box& start) {
  Film film = moving(scene, start, kPlainly, 3);
  for (int i = 0; i < 6; ++i) film.add(scene.wall(), "the target has vanished");
  for (int i = 0; i < 2; ++i) film.add(scene.with_target(start), "the target is back");
  return film;
}

Film blank(const Scene& scene, const Box& start) {
  Film film = moving(scene, start, kPlainly, 2);
  for (int i = 0; i < 2; ++i) film.add(flat(scene.size(), 0), "a black picture");
  for (int i = 0; i < 2; ++i) film.add(flat(scene.size(), 255), "a white picture");
  for (std::uint64_t i = 0; i < 3; ++i) film.add(noise(scene.size(), i), "a picture of noise");
  for (int i = 0; i < 2; ++i) film.add(scene.with_target(start), "a good picture after blank ones");
  return film;
}

Film grey_between(const Scene& scene, const Box& start, PixelFormat first) {
  Film film = moving(scene, start, kPlainly, 4);
  for (std::size_t i = 0; i < film.shots.size(); ++i) {
    const bool as_first = i % 2 == 0;
    const bool grey = as_first == (first == PixelFormat::gray8);
    if (grey) film.shots[i].picture = grey_of(film.shots[i].picture);
    film.shots[i].what = grey ? "grey after colour" : "colour after grey";
  }
  return film;
}

Film gappy(const Scene& scene, const Box& start) {
  using namespace std::chrono_literals;
  Film film = moving(scene, start, kPlainly, 2);
  film.add(scene.with_target(moved(start, {6, 2})), "after 5 lost frames", 5);
  film.add(scene.with_target(moved(start, {8, 3})), "after 5 s without a frame", 149);
  film.add(scene.with_target(moved(start, {10, 3})), "after a pause of 5 s in which no frame was taken", 0,
           5s);
  film.add(scene.with_target(moved(start, {12, 4})), "after a million lost frames", 1'000'000);
  return film;
}

}  // namespace relock
