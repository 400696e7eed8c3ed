#include "sequences/simulator/occluder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sequences/simulator/layout.h"
#include "sequences/simulator/material.h"

namespace relock::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kRest = 4.0;         // m above the target
constexpr double kFirstPass = 1.0;    // s: a tracker is shown its target before
constexpr double kLongestPass = 1.8;  // s

// Passes number `turn`, `turn + turns`, … of those before one target.
struct Passes {
  Random random;
  double hz;
  std::int64_t turn, turns;
  double begin_s;  // of slot 0
  double astray;   // m: how far from the target's middle a pass may go
  Vector3d right, down;

  Vector3d shift(double t) const {
    // The slot of this thing's last pass that may have begun; if it has not, the pass before is long over.
    const double slots = (t - begin_s) * hz - static_cast<double>(turn);
    const auto round = static_cast<std::int64_t>(std::floor(slots / static_cast<double>(turns)));
    if (round < 0) return -kRest * down;
    const std::int64_t slot = turn + round * turns;
    Random pass = random.fork(static_cast<std::uint64_t>(slot));
    const double begin = begin_s + (static_cast<double>(slot) + pass.uniform()) / hz;
    const double lasts = 1.2 + (kLongestPass - 1.2) * pass.uniform();
    const double sweep = (pass.chance(0.5) ? 1 : -1) * (0.4 + 0.9 * pass.uniform());
    const double off_x = astray * (2 * pass.uniform() - 1), off_y = astray * (2 * pass.uniform() - 1);
    const double s = std::clamp(2 * (t - begin) / lasts - 1, -1.0, 1.0);  // 0: before the target
    const double near = 1 - s * s, lift = kRest * s * s * s * s * (3 - 2 * s * s);
    return near * (sweep * s + off_x) * right + (near * off_y - lift) * down;
  }
};

// Coverage: a blob that keeps to more than 0.75 of the way to the edge; a board; a rod; leaves on a twig.
cv::Mat blob(int side, Random& random) {
  const double a = 2 * M_PI * random.uniform(), b = 2 * M_PI * random.uniform();
  std::vector<cv::Point> outline;
  for (int i = 0; i < 120; ++i) {
    const double turn = 2 * M_PI * i / 120;
    const double radius = side * (0.43 + 0.035 * std::sin(3 * turn + a) + 0.02 * std::sin(7 * turn + b));
    outline.emplace_back(static_cast<int>(std::lround(16 * (side / 2.0 + radius * std::cos(turn)))),
                         static_cast<int>(std::lround(16 * (side / 2.0 + radius * std::sin(turn)))));
  }
  cv::Mat mask(side, side, CV_8UC1, cv::Scalar(0));
  cv::fillPoly(mask, std::vector{outline}, cv::Scalar(255), cv::LINE_AA, 4);
  return mask;
}

cv::Mat board(int side, Random&) {
  cv::Mat mask(side, side, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(side / 20, side / 20, side - side / 10, side - side / 10)).setTo(255);
  return mask;
}

cv::Mat rod(int side, Random& random) {
  cv::Mat mask(side, side, CV_8UC1, cv::Scalar(0));
  const int lean = static_cast<int>(random.below(static_cast<std::uint64_t>(side / 4)));
  cv::line(mask, {side / 2 - lean, side / 12}, {side / 2 + lean, side - side / 12}, cv::Scalar(255), side / 7,
           cv::LINE_AA);
  return mask;
}

cv::Mat leaves(int side, Random& random) {
  cv::Mat mask(side, side, CV_8UC1, cv::Scalar(0));
  cv::line(mask, {side / 8, side / 6}, {side - side / 8, side - side / 6}, cv::Scalar(255), side / 40,
           cv::LINE_AA);
  for (int i = 0; i < 14; ++i) {
    const double along = 0.15 + 0.7 * random.uniform();
    const int x = static_cast<int>(side * (along + 0.1 * (random.uniform() - 0.5)));
    const int y = static_cast<int>(side * (0.08 + 0.84 * along + 0.3 * (random.uniform() - 0.5)));
    const double turn = 180 * random.uniform();
    cv::ellipse(mask, {std::clamp(x, side / 7, side - side / 7), std::clamp(y, side / 7, side - side / 7)},
                {side / 9, side / 22}, turn, 0, 360, cv::Scalar(255), cv::FILLED, cv::LINE_AA);
  }
  return mask;
}

struct Form {
  cv::Mat (*mask)(int, Random&);
  double width;  // in sizes of the target
  Finish finish;
};

// Even ones hide all of a target, the others a part.
std::array<Form, 4> forms(Random& random) {
  const auto tone = [&] { return 0.15 + 0.4 * random.uniform(); };
  const double skin = tone(), grey = tone(), brown = tone();
  return {
      {{blob, 2.2, {Material::plaster, random.next(), paint(1.1 * skin, 0.75 * skin, 0.6 * skin), false}},
       {rod, 2.4, {Material::wood, random.next(), paint(brown, 0.6 * brown, 0.35 * brown), true}},
       {board, 2.0, {Material::cardboard, random.next(), paint(brown, 0.8 * brown, 0.55 * brown), false}},
       {leaves, 1.8, {Material::concrete, random.next(), paint(0.3 * grey, 0.7 * grey, 0.2 * grey), false}}}};
}

Surface hang_before(const Surface& sheet, double away, double width) {
  Surface made;
  made.right = width * sheet.right.normalized();
  made.down = width * sheet.down.normalized();
  made.corner = middle_of(sheet) + away * outward(sheet) - 0.5 * (made.right + made.down);
  return made;
}

cv::Mat picture_of(const Form& form, double width_m, Random& random) {
  Canvas canvas({0, 0, width_m, width_m}, 224 / width_m);
  cover(canvas, form.finish);
  cv::Mat channels[] = {canvas.picture, form.mask(canvas.picture.cols, random)},
          picture(canvas.picture.size(), CV_8UC4);
  const int places[] = {0, 0, 1, 1, 2, 2, 3, 3};
  cv::mixChannels(channels, 2, &picture, 1, places, 4);
  return picture;
}

}  // namespace

std::vector<Surface> passers_before(const Surface& sheet, double size_m, double hz, const Light& light,
                                    Random random) {
  if (hz <= 0) return {};
  std::vector<Surface> kinds;
  for (const Form& form : forms(random)) {
    Surface made = hang_before(sheet, 0.03 + 0.07 * random.uniform(), form.width * size_m);
    made.texture = std::make_shared<Texture>(
        make_texture(picture_of(form, form.width * size_m, random), light.over(made, 0.05)));
    kinds.push_back(made);
  }
  // So many that the next pass of each begins well after its last is over.
  const auto turns = std::max<std::int64_t>(2, static_cast<std::int64_t>(std::ceil(4 * hz)));
  const double begin = kFirstPass + random.uniform() / hz;
  const std::uint64_t first = random.below(2) * 2;
  std::vector<Surface> passers;
  for (std::int64_t turn = 0; turn < turns; ++turn) {
    const std::size_t kind = (static_cast<std::size_t>(turn) + first) % kinds.size();
    Surface made = kinds[kind];
    const double astray = kind % 2 == 0 ? 0.06 * size_m : 0.5 * size_m;
    const Passes passes{random.fork(1),         hz, turn, turns, begin, astray, sheet.right.normalized(),
                        sheet.down.normalized()};
    made.shift = [passes](double t) { return passes.shift(t); };
    passers.push_back(made);
  }
  return passers;
}

}  // namespace relock::simulator
