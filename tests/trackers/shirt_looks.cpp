#include "tests/trackers/shirt_looks.h"

#include <fmt/format.h>

#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/random.h"
#include "source_folder.h"

namespace relock {
namespace {

constexpr int kSide = 20, kSharp = 10;
/// In the first frame (labels.csv); it moves little in 30 frames.
constexpr Box kShirt{260.3, 46.19, 39.61, 52.84};

cv::Mat1f photo(int number) {
  cv::Mat1f grey;
  cv::imread(fmt::format(RELOCK_SOURCE_DIR "/recordings/klahaag/images/{:05d}.jpg", number),
             cv::IMREAD_GRAYSCALE)
      .convertTo(grey, CV_32F, 1 / 255.0);
  CV_Assert(!grey.empty());
  return grey;
}

cv::Mat1f blurred(const cv::Mat1f& picture, const BlurEstimate& blur) {
  cv::Mat1f exposed;
  cv::filter2D(picture, exposed, CV_32F, blur_kernel(blur), {-1, -1}, 0, cv::BORDER_REPLICATE);
  return exposed;
}

Eigen::VectorXf whitened(Eigen::VectorXf values) {
  values.array() -= values.mean();
  return values.normalized();
}

Eigen::VectorXf look(const cv::Mat1f& picture, Vec2 shift, double scale) {
  const auto width = static_cast<int>(std::lround(scale * kShirt.width)),
             height = static_cast<int>(std::lround(scale * kShirt.height));
  const cv::Point2d centre(kShirt.x + kShirt.width / 2 + shift.x, kShirt.y + kShirt.height / 2 + shift.y);
  cv::Mat1f box, small;
  cv::getRectSubPix(picture, {width, height}, centre, box);
  cv::resize(box, small, {kSide, kSide}, 0, 0, cv::INTER_AREA);
  return whitened(Eigen::Map<const Eigen::VectorXf>(small.ptr<float>(), kSide * kSide));
}

}  // namespace

Looks shirt_looks(int count, std::uint64_t seed, int directions, int lengths, double spread) {
  const int blurs = directions * lengths;
  Looks made{Eigen::MatrixXf(kSide * kSide, kSharp + blurs + 1),
             Eigen::VectorXf::Constant(kSharp + blurs + 1, 0.01F), Eigen::MatrixXf(kSide * kSide, count)};
  Random random(seed);
  const cv::Mat1f first = photo(1);
  for (int i = 0; i < kSharp; ++i)
    made.dictionary.col(i) = look(first, i == 0 ? Vec2{} : Vec2{random.normal(), random.normal()}, 1);
  for (int i = 0; i < blurs; ++i) {
    const double share = 0.05 + 0.35 * (i % lengths) / std::max(lengths - 1, 1);
    made.dictionary.col(kSharp + i) =
        look(blurred(first, {.direction_rad = std::numbers::pi * (i / lengths) / directions,
                             .length_px = share * kShirt.width}),
             {}, 1);
  }
  made.dictionary.col(kSharp + blurs) = made.dictionary.col(0);

  constexpr int kFrames = 20;
  cv::Mat1f picture;
  for (int i = 0, shown = -1; i < count; ++i) {
    const int frame = i * kFrames / count;
    if (frame != shown) {
      picture = photo(2 + frame);
      if (frame % 2 == 1)
        picture = blurred(picture, {.direction_rad = random.uniform() * std::numbers::pi,
                                    .length_px = random.uniform() * kShirt.width / 2});
      shown = frame;
    }
    const double sigma = spread * kShirt.width;
    const double x = sigma * random.normal(), y = sigma * random.normal();
    made.looks.col(i) = look(picture, {x, y}, std::exp(0.02 * random.normal()));
  }
  return made;
}

Looks random_looks(int count, std::uint64_t seed, int templates) {
  Random random(seed);
  constexpr int kPixels = kSide * kSide;
  const auto noise = [&] {
    return whitened(
        Eigen::VectorXf::NullaryExpr(kPixels, [&] { return static_cast<float>(random.normal()); }));
  };
  Looks made{Eigen::MatrixXf(kPixels, templates), Eigen::VectorXf(templates),
             Eigen::MatrixXf(kPixels, count)};
  for (int j = 0; j < templates; ++j) {
    made.dictionary.col(j) = noise();
    made.weights(j) = static_cast<float>(0.002 + 0.02 * random.uniform());
  }
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXf made_of = Eigen::VectorXf::Zero(kPixels);
    for (int part = 0; part < i % 4; ++part)
      made_of += made.dictionary.col(
                     static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(templates)))) *
                 static_cast<float>(random.uniform());
    made_of += noise() * 0.3F;
    if (i % 3 == 0) made_of.head(kPixels / 5).setConstant(0.1F);
    made.looks.col(i) = whitened(made_of);
  }
  return made;
}

}  // namespace relock
