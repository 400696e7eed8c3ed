#include "eval/inspection/blur_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/opencv.h"

namespace relock {
namespace {

using std::numbers::pi;

constexpr double kShortest_px = 2;  // looked for, so that a blur below kLeastBlur_px has where to go
constexpr double kToldFromNone_px = 2.6;
constexpr double kLengthStep = 1.25;
constexpr double kLeastGain = 0.01;           // a frequency
constexpr double kLeastGainOfRegion = 0.035;  // few windows: chance alone gains more
constexpr double kMostRival = 0.5;  // gain of the best answer of another direction, in that of the best
constexpr double kOtherDirection_rad = pi / 6;
constexpr double kLobe_px = 4;  // shorter blurs show no lobe: other causes look alike
constexpr double kNoiseQuantile = 0.1;
constexpr int kRounds = 5;
constexpr int kMostAcross = 12, kMostDown = 8;  // windows

/// What is left where a blur lets nothing through: windows are short, and motion is never quite even.
constexpr double kLeak = 0.02;

double blur_power(double periods) {
  if (std::abs(periods) < 1e-6) return 1;
  const double s = std::sin(pi * periods) / (pi * periods);
  return kLeak + (1 - kLeak) * s * s;
}

/// First pixels of `window` px windows that overlap by half and cover [begin, begin + length) of `full` px.
std::vector<int> windows_over(double begin, double length, int full, int window, int most) {
  const int covered = std::min(full, std::max(window, static_cast<int>(std::lround(length))));
  const double middle = begin + length / 2;
  const int first = std::clamp(static_cast<int>(std::lround(middle - covered / 2.0)), 0, full - covered);
  const int count = std::min(most, 1 + static_cast<int>(std::lround(2.0 * (covered - window) / window)));
  std::vector<int> all;
  for (int i = 0; i < count; ++i)
    all.push_back(count == 1 ? first + (covered - window) / 2 : first + (covered - window) * i / (count - 1));
  return all;
}

/// Blurs without a lobe are believed less.
double weight(double length_px) {
  const double share = std::min(1.0, length_px / kLobe_px);
  return share * share;
}

double angle_between(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, pi - d);
}

}  // namespace

BlurEstimator::BlurEstimator() {
  double length = kShortest_px;
  for (int i = 0; i < kLengths; ++i, length *= kLengthStep) {
    lengths_px_.push_back(length);
    blur_.push_back(blurred_by(length));
  }
  cell_of_frequency_.assign(static_cast<std::size_t>(kWindow) * kWindow, -1);
  for (int y = 0; y < kWindow; ++y) {
    const int fy = y <= kWindow / 2 ? y : y - kWindow;
    for (int x = 0; x <= kWindow / 2; ++x) {
      if (x == 0 && fy < 0) continue;  // there already, at the other sign
      const int ring = static_cast<int>(std::lround(std::hypot(x, fy))) - kFirstRing;
      if (ring < 0 || ring >= kRings) continue;
      const double turn = std::atan2(fy, x) / pi;
      const int sector = (static_cast<int>(std::lround(turn * kSectors)) + kSectors) % kSectors;
      cell_of_frequency_[static_cast<std::size_t>(y * kWindow + x)] = ring * kSectors + sector;
    }
  }
  for (int i = 0; i < kWindow; ++i)
    taper_.push_back(static_cast<float>(0.5 - 0.5 * std::cos(2 * pi * (i + 0.5) / kWindow)));
}

BlurEstimator::Cells BlurEstimator::blurred_by(double length_px) {
  Cells cells{};
  for (int ring = 0; ring < kRings; ++ring)
    for (int sector = 0; sector < kSectors; ++sector) {
      double sum = 0;  // over a cell of 3 x 3 points
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          const double frequency = (ring + kFirstRing + i / 3.0) / kWindow;
          sum += blur_power(length_px * frequency * std::cos((sector + j / 3.0) * pi / kSectors));
        }
      cells[static_cast<std::size_t>(ring * kSectors + sector)] = sum / 9;
    }
  return cells;
}

BlurEstimator::Cells BlurEstimator::turned(const Cells& blur, int sectors) {
  Cells cells = blur;
  for (int ring = 0; ring < kRings; ++ring) {
    const auto begin = cells.begin() + ring * kSectors;
    std::rotate(begin, begin + (kSectors - sectors) % kSectors, begin + kSectors);
  }
  return cells;
}

BlurEstimator::Spectrum BlurEstimator::spectrum_of(const cv::Mat& gray, const Box& region) const {
  cv::Mat taper;
  const cv::Mat across(1, kWindow, CV_32F, const_cast<float*>(taper_.data()));
  cv::mulTransposed(across, taper, true);
  cv::Mat power(kWindow, kWindow, CV_32F, cv::Scalar(0)), window, tapered, transformed;
  for (const int y : windows_over(region.y + 0.5, region.height, gray.rows, kWindow, kMostDown))
    for (const int x : windows_over(region.x + 0.5, region.width, gray.cols, kWindow, kMostAcross)) {
      gray(cv::Rect(x, y, kWindow, kWindow)).convertTo(window, CV_32F);
      window -= cv::Scalar(window.dot(taper) / cv::sum(taper)[0]);
      tapered = window.mul(taper);
      cv::dft(tapered, transformed, cv::DFT_COMPLEX_OUTPUT);
      cv::Mat part[2], square;
      cv::split(transformed, part);
      cv::magnitude(part[0], part[1], square);
      cv::accumulateSquare(square, power);
    }

  Spectrum spectrum;
  for (int i = 0; i < kWindow * kWindow; ++i) {
    const int cell = cell_of_frequency_[static_cast<std::size_t>(i)];
    if (cell < 0) continue;
    spectrum.power[static_cast<std::size_t>(cell)] +=
        static_cast<double>(power.at<float>(i / kWindow, i % kWindow));
    ++spectrum.count[static_cast<std::size_t>(cell)];
    ++spectrum.frequencies;
  }
  std::vector<double> weakest;
  for (std::size_t i = 0; i < spectrum.power.size(); ++i) {
    if (spectrum.count[i] > 0) spectrum.power[i] /= spectrum.count[i];
    if (spectrum.count[i] > 1) weakest.push_back(spectrum.power[i]);
  }
  const auto at =
      weakest.begin() + static_cast<long>(kNoiseQuantile * static_cast<double>(weakest.size() - 1));
  std::nth_element(weakest.begin(), at, weakest.end());
  spectrum.noise = std::max(*at, 1e-6);
  return spectrum;
}

namespace {

/// Power as ring(frequency) * sector(direction) * blur + noise.
template <class Spectrum, class Cells>
class SeparableFit {
 public:
  SeparableFit(const Spectrum& spectrum, const Cells& blur, std::size_t rings, std::size_t sectors)
      : s_(spectrum), blur_(blur), ring_(rings, 1.0), sector_(sectors, 1.0) {}

  /// A first guess: the mean ratio of what is above the noise to the other factors.
  void guess() {
    update(ring_, [this](std::size_t at, double others) { return guess_of(at, others); });
    update(sector_, [this](std::size_t at, double others) { return guess_of(at, others); });
  }
  /// The multiplicative step of non-negative matrix factorisation for this likelihood (Fevotte, Bertin and
  /// Durrieu 2009).
  void improve() {
    const auto step = [this](std::size_t at, double others, double own) {
      const double model = own * others + s_.noise, share = s_.count[at] * others / model;
      return Ratio{own * share * s_.power[at] / model, share};
    };
    update_with_own(ring_, step);
    update_with_own(sector_, step);
  }
  /// Minus the logarithm of Whittle's likelihood.
  double misfit() const {
    double sum = 0;
    each_cell([&](std::size_t at, std::size_t r, std::size_t k) {
      const double model = ring_[r] * sector_[k] * blur_[at] + s_.noise;
      sum += s_.count[at] * (s_.power[at] / model + std::log(model));
    });
    return sum;
  }

 private:
  struct Ratio {
    double above = 0, below = 0;
  };
  Ratio guess_of(std::size_t at, double others) const {
    const double weight = s_.count[at] * blur_[at];
    return {weight * std::max(s_.power[at] - s_.noise, 0.0) / others, weight};
  }
  template <class Use>
  void each_cell(Use use) const {
    std::size_t at = 0;
    for (std::size_t r = 0; r < ring_.size(); ++r)
      for (std::size_t k = 0; k < sector_.size(); ++k, ++at)
        if (s_.count[at] > 0) use(at, r, k);
  }
  template <class Term>
  void update(std::vector<double>& factor, Term term) {
    update_with_own(factor, [&](std::size_t at, double others, double) { return term(at, others); });
  }
  template <class Term>
  void update_with_own(std::vector<double>& factor, Term term) {
    const bool rings = &factor == &ring_;
    std::vector<Ratio> sums(factor.size());
    each_cell([&](std::size_t at, std::size_t r, std::size_t k) {
      const std::size_t own = rings ? r : k;
      const Ratio add = term(at, (rings ? sector_[k] : ring_[r]) * blur_[at], factor[own]);
      sums[own].above += add.above, sums[own].below += add.below;
    });
    for (std::size_t i = 0; i < factor.size(); ++i)
      if (sums[i].below > 0) factor[i] = sums[i].above / sums[i].below + kLeastFactor;
  }

  static constexpr double kLeastFactor = 1e-9;
  const Spectrum& s_;
  const Cells& blur_;
  std::vector<double> ring_, sector_;
};

}  // namespace

double BlurEstimator::misfit(const Spectrum& spectrum, const Cells& blur) {
  SeparableFit fit(spectrum, blur, kRings, kSectors);
  fit.guess();
  fit.guess();
  for (int round = 0; round < kRounds; ++round) fit.improve();
  return fit.misfit();
}

// Lengths between those of the table: the top of a parabola through the best one and its neighbours.
BlurEstimator::Candidate BlurEstimator::refined(const Spectrum& spectrum, double no_blur,
                                                const Candidate& best) const {
  constexpr double step = 1.12;
  const int sectors = static_cast<int>(std::lround(best.direction_rad / pi * kSectors));
  const auto gain = [&](double length_px) {
    return (no_blur - misfit(spectrum, turned(blurred_by(length_px), sectors))) / spectrum.frequencies;
  };
  const double shorter = gain(best.length_px / step), longer = gain(best.length_px * step);
  const double bend = shorter - 2 * best.gain + longer;
  const double top = bend < 0 ? std::clamp(0.5 * (shorter - longer) / bend, -1.0, 1.0) : 0;
  return {best.length_px * std::pow(step, top), best.direction_rad, best.gain};
}

std::optional<BlurEstimate> BlurEstimator::estimate(const Image& picture,
                                                    const std::optional<Box>& region) const {
  const Box whole = picture_box(picture.size());
  const Box where = region ? intersect(*region, whole) : whole;
  if (picture.size().width < kWindow || picture.size().height < kWindow) return {};
  if (std::min(where.width, where.height) < kLeastBlurRegion_px) return {};
  cv::Mat buffer;
  const Spectrum spectrum = spectrum_of(gray_of(picture, buffer), where);

  Cells none;
  none.fill(1);
  const double no_blur = misfit(spectrum, none);
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < lengths_px_.size(); ++i)
    for (int sectors = 0; sectors < kSectors; ++sectors)
      all.push_back({lengths_px_[i], sectors * pi / kSectors,
                     (no_blur - misfit(spectrum, turned(blur_[i], sectors))) / spectrum.frequencies});
  const auto belief = [](const Candidate& c) { return weight(c.length_px) * c.gain; };
  const auto less = [&](const Candidate& a, const Candidate& b) { return belief(a) < belief(b); };
  const Candidate best = *std::max_element(all.begin(), all.end(), less);
  if (belief(best) < (region ? kLeastGainOfRegion : kLeastGain) || best.length_px < kToldFromNone_px)
    return BlurEstimate{};
  for (const Candidate& rival : all)
    if (angle_between(rival.direction_rad, best.direction_rad) > kOtherDirection_rad &&
        belief(rival) > kMostRival * belief(best))
      return {};
  const Candidate found = refined(spectrum, no_blur, best);
  if (found.length_px < kToldFromNone_px) return BlurEstimate{};
  return BlurEstimate{found.direction_rad, found.length_px};
}

}  // namespace relock
