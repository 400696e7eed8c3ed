#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/image.h"
#include "core/sighting.h"

namespace cv {
class Mat;
}

namespace relock {

/// Shortest motion blur that is told from none, px. What is shorter is answered as a length of 0.
constexpr double kLeastBlur_px = 3;
/// Longest motion blur that is looked for, px. A longer one is missed, or answered as some shorter one.
constexpr double kMostBlur_px = 20;
/// Smallest region that is looked at, px: in a smaller one most of a window would be background.
constexpr double kLeastBlurRegion_px = 32;

/// Estimates motion blur in a picture from the picture alone.
///
/// A straight, even motion over the exposure multiplies the power spectrum by sinc^2(L f.u), with L the
/// length and u the direction of the blur. The sharp picture is unknown; its spectrum is taken to be a free
/// function of frequency times a free function of direction, on top of white noise. So edges that run one
/// way only, or a lens that blurs every way alike, do not pass for motion. Of all lengths and directions the
/// most likely is taken (Whittle's likelihood, over 64 px windows that overlap by half).
///
/// What it is good for was measured by blurring pictures of one real clip, on which its
/// thresholds were chosen too (tests/eval/blur_estimate_test.cpp prints the
/// table): on a whole picture, lengths from 3 to 20 px within 10 %, directions within 5 degrees from 6 px on and
/// 15 below; on a target of 40 to 60 px eight of ten answers from 3 to 9 px are within 25 % and 0.5 px, but
/// about half of such blurs pass for none. Repeated patterns deceive it: on printed markers
/// with cells of 6 px (recordings/klahaag-prints) the few answers that it gives are the cells, not the blur.
class BlurEstimator {
 public:
  BlurEstimator();

  /// Blur of the whole picture, or of the part of it in `region` (px). Length 0: below kLeastBlur_px, or
  /// hardly any detail to tell it from. Nothing: it cannot be told, two answers are about as likely; or the
  /// region or the picture is too small.
  std::optional<BlurEstimate> estimate(const Image& picture, const std::optional<Box>& region = {}) const;

 private:
  static constexpr int kWindow = 64;    // px
  static constexpr int kSectors = 24;   // of direction, over half a turn
  static constexpr int kRings = 23;     // of frequency, from 2 periods a window on: 0.03 to 0.38 a pixel
  static constexpr int kLengths = 11;   // each a quarter longer than the one before
  static constexpr int kFirstRing = 2;  // periods a window; below it the window's own shape shows
  /// A number for each ring and sector, ring by ring.
  using Cells = std::array<double, kRings * kSectors>;
  /// What the windows show: mean power of each cell, and how many frequencies fall into it.
  struct Spectrum {
    Cells power{};
    Cells count{};
    double frequencies = 0;
    double noise = 0;
  };
  /// A blur and how much better, a frequency, it explains the spectrum than no blur does.
  struct Candidate {
    double length_px = 0;
    double direction_rad = 0;
    double gain = 0;
  };

  Spectrum spectrum_of(const cv::Mat& gray, const Box& region) const;
  static double misfit(const Spectrum& spectrum, const Cells& blur);
  static Cells blurred_by(double length_px);
  static Cells turned(const Cells& blur, int sectors);
  Candidate refined(const Spectrum& spectrum, double no_blur, const Candidate& best) const;

  std::vector<double> lengths_px_;
  std::vector<Cells> blur_;             // for each length, along +x
  std::vector<int> cell_of_frequency_;  // of the window's half plane; -1: of none
  std::vector<float> taper_;
};

}  // namespace relock
