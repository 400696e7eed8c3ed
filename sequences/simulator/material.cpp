#include "sequences/simulator/material.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "sequences/simulator/grain.h"

namespace relock::simulator {
namespace {

using Colour = cv::Vec3f;

Colour colour_of(const cv::Scalar& s) {
  return {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
}

// Asks `colour_at` (m) for every pixel and shades it with the grain: `strength` is its standard deviation.
template <class ColourAt>
void shade(Canvas& canvas, const Grain& grain, double strength, ColourAt colour_at) {
  const cv::Mat tone = grain_over(grain, canvas.area, canvas.picture.size());
  const double step_x = canvas.area.width / canvas.picture.cols;
  const double step_y = canvas.area.height / canvas.picture.rows;
  for (int y = 0; y < canvas.picture.rows; ++y) {
    const auto* shades = tone.ptr<float>(y);
    auto* out = canvas.picture.ptr<cv::Vec3b>(y);
    const double down = canvas.area.y + (y + 0.5) * step_y;
    for (int x = 0; x < canvas.picture.cols; ++x) {
      const Colour colour = colour_at(canvas.area.x + (x + 0.5) * step_x, down);
      const float factor = 1.0f + static_cast<float>(strength) * shades[x];
      for (int c = 0; c < 3; ++c) out[x][c] = cv::saturate_cast<uchar>(colour[c] * factor);
    }
  }
}

// 1 inside of a cell, 0 in the joint around it, and between over `soft`.
double inside(double place, double cell, double joint, double soft) {
  const double rest = place - cell * std::floor(place / cell);
  const double from_edge = std::min(rest, cell - rest) - joint / 2;
  return std::clamp(from_edge / soft + 0.5, 0.0, 1.0);
}

void cover_plaster(Canvas& canvas, const Finish& finish) {
  const Colour base = colour_of(finish.colour);
  shade(canvas, {.seed = finish.seed, .coarsest_m = 0.8, .finest_m = 0.003, .fall = 0.93}, 0.04,
        [&](double, double) { return base; });
}

void cover_wallpaper(Canvas& canvas, const Finish& finish) {
  const double period = 0.12 + 0.16 * number_of_cell(finish.seed, 1, 0);
  const Colour base = colour_of(finish.colour);
  const Colour other = base * static_cast<float>(0.80 + 0.1 * number_of_cell(finish.seed, 2, 0));
  const double soft = 2 / canvas.texels_per_m();
  shade(canvas, {.seed = finish.seed, .coarsest_m = 0.8, .finest_m = 0.002, .fall = 0.9}, 0.04,
        [&](double x, double y) {
          const double stripe = inside(x, period, period * 0.45, soft);
          // A row of leaves within each stripe, left and right in turn.
          const double sway = 0.12 * period * std::sin(2 * M_PI * y / (0.8 * period));
          const double leaf = 0.05 * period * (1 + std::sin(4 * M_PI * y / (0.8 * period)));
          const double off = std::abs(x / period - std::floor(x / period) - 0.5) * period - sway;
          const double printed = std::clamp((leaf - std::abs(off)) / soft + 0.5, 0.0, 1.0);
          return Colour(other + (base - other) * static_cast<float>(stripe * (1 - 0.8 * printed)));
        });
}

void cover_brick(Canvas& canvas, const Finish& finish) {
  constexpr double kLong = 0.25, kHigh = 0.083, kJoint = 0.012;
  const Colour base = colour_of(finish.colour);
  const Colour mortar = colour_of(paint(0.42, 0.40, 0.37));
  const double soft = std::max(0.004, 1 / canvas.texels_per_m());
  shade(canvas, {.seed = finish.seed, .coarsest_m = 0.6, .finest_m = 0.003, .fall = 0.95}, 0.09,
        [&](double x, double y) {
          const auto row = static_cast<std::int64_t>(std::floor(y / kHigh));
          const double along = x + (row % 2 == 0 ? 0.0 : kLong / 2);
          const auto column = static_cast<std::int64_t>(std::floor(along / kLong));
          const auto burnt = static_cast<float>(number_of_cell(finish.seed, column, row));
          const Colour brick = Colour(base[0] * (1.1f - 0.3f * burnt), base[1] * (1.1f - 0.3f * burnt),
                                      base[2] * (1.05f - 0.15f * burnt));
          const double solid = inside(along, kLong, kJoint, soft) * inside(y, kHigh, kJoint, soft);
          return Colour(mortar + (brick - mortar) * static_cast<float>(solid));
        });
}

void cover_concrete(Canvas& canvas, const Finish& finish) {
  constexpr double kFormwork = 1.2;
  const Colour base = colour_of(finish.colour);
  const double soft = 1.5 / canvas.texels_per_m();
  shade(canvas, {.seed = finish.seed, .coarsest_m = 1.2, .finest_m = 0.003, .fall = 0.85}, 0.09,
        [&](double x, double y) {
          const double slab = inside(x, kFormwork, 0.006, soft) * inside(y, kFormwork, 0.006, soft);
          const double u = x / kFormwork - std::floor(x / kFormwork) - 0.5;
          const double v = y / kFormwork - std::floor(y / kFormwork) - 0.5;
          const double from_hole = std::hypot(std::abs(u) - 0.28, std::abs(v) - 0.28) * kFormwork - 0.014;
          const double hole = std::clamp(from_hole / soft + 0.5, 0.0, 1.0);
          return Colour(base * static_cast<float>((0.55 + 0.45 * slab) * (0.4 + 0.6 * hole)));
        });
}

void cover_wood(Canvas& canvas, const Finish& finish) {
  constexpr double kBoard = 0.14;
  const Colour base = colour_of(finish.colour);
  const double soft = 1 / canvas.texels_per_m();
  // Grain runs along x: boards that run down are painted lying and turned.
  Canvas lying = canvas;
  if (finish.upright) {
    lying.area = {canvas.area.y, canvas.area.x, canvas.area.height, canvas.area.width};
    lying.picture = cv::Mat(canvas.picture.cols, canvas.picture.rows, CV_8UC3);
  }
  shade(lying, {.seed = finish.seed, .coarsest_m = 0.09, .finest_m = 0.002, .fall = 0.9, .stretch = 14}, 0.13,
        [&](double x, double y) {
          const auto row = static_cast<std::int64_t>(std::floor(y / kBoard));
          const double start = 1.7 * number_of_cell(finish.seed, 7, row);
          const auto board = static_cast<std::int64_t>(std::floor((x + start) / 1.7));
          const double tone = 0.8 + 0.35 * number_of_cell(finish.seed, board, row);
          const double joint = inside(y, kBoard, 0.004, soft) * inside(x + start, 1.7, 0.004, soft);
          return Colour(base * static_cast<float>(tone * (0.35 + 0.65 * joint)));
        });
  if (finish.upright) cv::transpose(lying.picture, canvas.picture);
}

void cover_tiles(Canvas& canvas, const Finish& finish) {
  constexpr double kTile = 0.4;
  const Colour base = colour_of(finish.colour);
  const Colour joint = base * 0.55f;
  const double soft = 1 / canvas.texels_per_m();
  shade(canvas, {.seed = finish.seed, .coarsest_m = 0.5, .finest_m = 0.003, .fall = 0.9}, 0.06,
        [&](double x, double y) {
          const auto column = static_cast<std::int64_t>(std::floor(x / kTile));
          const auto row = static_cast<std::int64_t>(std::floor(y / kTile));
          const double tone = 0.9 + 0.15 * number_of_cell(finish.seed, column, row);
          const double solid = inside(x, kTile, 0.008, soft) * inside(y, kTile, 0.008, soft);
          return Colour(joint + (base * static_cast<float>(tone) - joint) * static_cast<float>(solid));
        });
}

void cover_cardboard(Canvas& canvas, const Finish& finish) {
  const Colour base = colour_of(finish.colour);
  shade(canvas, {.seed = finish.seed, .coarsest_m = 0.3, .finest_m = 0.002, .fall = 0.8, .stretch = 0.25},
        0.05, [&](double x, double) {
          return Colour(base * static_cast<float>(1 + 0.025 * std::sin(2 * M_PI * x / 0.008)));
        });
}

}  // namespace

void cover(Canvas& canvas, const Finish& finish) {
  switch (finish.material) {
    case Material::plaster:
      return cover_plaster(canvas, finish);
    case Material::wallpaper:
      return cover_wallpaper(canvas, finish);
    case Material::brick:
      return cover_brick(canvas, finish);
    case Material::concrete:
      return cover_concrete(canvas, finish);
    case Material::wood:
      return cover_wood(canvas, finish);
    case Material::tiles:
      return cover_tiles(canvas, finish);
    case Material::cardboard:
      return cover_cardboard(canvas, finish);
  }
}

}  // namespace relock::simulator
