// What the detector ring-paper takes for a picture, beside one filter2D of 31 x 31 on the same picture.
// Usage: ring_paper_cost [ROUNDS]      20 if not given; the median of all rounds is printed

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/blur.h"
#include "core/opencv.h"
#include "core/random.h"
#include "detectors/ring_marker.h"
#include "detectors/ring_paper/detector.h"

namespace relock::ring_paper {
namespace {

double milliseconds(const std::function<void()>& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void draw_marker(cv::Mat1b& picture, Vec2 centre, double diameter) {
  const RingMarker marker{paper_ring_geometry(), "01"};
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const double rho = 2 * norm(Vec2{static_cast<double>(x), static_cast<double>(y)} - centre) / diameter;
      if (rho < marker.geometry.sheet_radius())
        picture(y, x) = cv::saturate_cast<std::uint8_t>(255 * reflectance(marker, rho));
    }
}

/// A wall with noise of this deviation and a marker on it, blurred, and noise of deviation 2 on top.
cv::Mat1b scene(cv::Size size, double texture, double diameter) {
  Random random(1);
  cv::Mat1b picture(size, std::uint8_t{128});
  for (std::uint8_t& level : picture)
    level = cv::saturate_cast<std::uint8_t>(level + texture * random.normal());
  draw_marker(picture, {size.width * 0.6, size.height * 0.5}, diameter);
  cv::filter2D(picture, picture, CV_8U, blur_kernel({0.5, texture > 0 ? 2.0 : 30.0}));
  for (std::uint8_t& level : picture) level = cv::saturate_cast<std::uint8_t>(level + 2 * random.normal());
  return picture;
}

void measure(const std::string& name, const cv::Mat1b& picture, int rounds, const RingPaperOptions& options) {
  RingPaperDetector detector(options);
  GaborBank bank({options.wavelength_px, options.aspect, options.spread, options.kernel_px});
  std::vector<double> whole, filter, components, reference;
  std::size_t parts = 0, found = 0;
  cv::Mat output;
  const cv::Mat kernel(31, 31, CV_32F, cv::Scalar(1.0 / 961));
  for (int round = 0; round < rounds;
       ++round) {  // by turns, so that other work on the machine meets all of them
    whole.push_back(milliseconds([&] { found = detector.detect(view(picture), {}).size(); }));
    const Look& look = detector.look(view(picture));
    parts = look.components.parts.size();
    filter.push_back(milliseconds([&] { bank.norm(picture); }));
    components.push_back(milliseconds(
        [&] { connected_components(look.binary, options.least_area_px, options.most_components); }));
    reference.push_back(milliseconds([&] { cv::filter2D(picture, output, CV_32F, kernel); }));
  }
  const double all = median(whole), first = median(filter), second = median(components);
  fmt::print(
      "{:<22} {:3}x{:3}  detect {:6.1f} ms  filter2D {:5.1f} ms  ratio {:4.1f}  filter {:2.0f} %  components "
      "{:2.0f} %  the rest {:2.0f} %  ({} components, {} found)\n",
      name, picture.cols, picture.rows, all, median(reference), all / median(reference), 100 * first / all,
      100 * second / all, std::max(0.0, 100 * (all - first - second) / all), parts, found);
}

}  // namespace
}  // namespace relock::ring_paper

int main(int argc, char** argv) {
  using namespace relock::ring_paper;
  const int rounds = argc > 1 ? std::stoi(argv[1]) : 20;
  cv::setNumThreads(1);
  for (const int bits : {2, 4, 6}) {
    relock::RingPaperOptions options;
    options.bits = bits;
    const double spent = milliseconds([&] { training_profiles(options); });
    fmt::print("training for {} bits   {:.0f} ms\n", bits, spent);
  }
  relock::RingPaperOptions all_components;
  all_components.least_area_px = 1;
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(640, 360)}) {
    measure("a marker", scene(size, 0, 120), rounds, {});
    measure("on a noisy wall", scene(size, 100, 120), rounds, {});
    measure("noise alone", scene(size, 100, 0), rounds, {});
    measure("with least_area_px=1", scene(size, 100, 0), rounds, all_components);
  }
}
