#pragma once

#include <algorithm>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "detectors/ring/exposure.h"

namespace relock::ring {

struct FitOptions {
  int pixels = 130;     ///< about so many are looked at
  int steps = 6;        ///< at most
  double psf_px = 0.6;  ///< of lens and pixel, standard deviation in px of the picture that is looked at
  /// The marker's middle has moved less than this in a step, in radii: good enough.
  double settled = 0.04;
  /// After three steps a fit with a larger misfit is given up.
  double hopeless = 0.8;
};

/// A view that explains a picture.
struct Fit {
  View view;
  Light light;
  /// What is left unexplained: the residual's standard deviation over that of the pixels themselves, 0 to 1.
  double misfit = 1;
  /// The part of the misfit that is no noise: that neighbouring pixels share. Noise alone leaves some .2 of the misfit.
  double structure = 1;
  double residual = 0;  ///< its standard deviation, grey levels
  int pixels = 0;       ///< that it rests on
};

/// Pixels and their grey values.
struct Samples {
  std::vector<float> x, y, grey;

  std::size_t size() const { return x.size(); }
  void clear() { x.clear(), y.clear(), grey.clear(); }
};

/// Calls `use` with every kBlock samples, or what is left of them: x, y, grey values and how many.
template <class Use>
void in_blocks(const Samples& samples, Use use) {
  const int all = static_cast<int>(samples.size());
  for (int from = 0; from < all; from += kBlock)
    use(&samples.x[static_cast<std::size_t>(from)], &samples.y[static_cast<std::size_t>(from)],
        &samples.grey[static_cast<std::size_t>(from)], std::min(kBlock, all - from));
}

/// How much a pixel counts that sees beyond the sheet for this part of its exposure: the picture may be off by some grey
/// levels in the black and the white, and by many beyond the sheet, where the model knows one level only.
inline float weight_of(float leaked) {
  constexpr float kOwnError = 4, kLeakError = 30;
  return kOwnError * kOwnError / (kOwnError * kOwnError + kLeakError * kLeakError * leaked * leaked);
}

/// Some `count` pixels, evenly spread over the marker's disc and the beginning of its quiet zone, as far as they
/// see next to nothing but the sheet during the whole exposure. `samples` is reused.
void spread_samples(const cv::Mat& gray, const RingModel& model, const View& view, int count,
                    Samples& samples);

/// Fits the exposure of markers of one geometry by Levenberg and Marquardt's method. Keeps its buffers.
class Fitter {
 public:
  explicit Fitter(RingModel& model) : model_(model) {}

  /// From a view near enough: half a ring in position. `gray` is CV_8UC1. Nothing where too little of the marker
  /// is in the picture or no marker explains it.
  std::optional<Fit> fit(const cv::Mat& gray, std::size_t code, const View& start, const FitOptions& options);
  /// Brightness of a marker in another picture of it, of whose view is known; `code` and `psf_px` as for `fit`.
  std::optional<Light> light_in(const cv::Mat& gray, std::size_t code, const View& view,
                                const FitOptions& options);
  /// How bright each annulus is by itself, in the view of a fit, as parts of what the two rings that are always white
  /// are on average; with the standard error of each.
  struct AnnulusLight {
    double light = 0, error = 0;  ///< 0 black, 1 white
  };
  struct RingLights {
    std::vector<AnnulusLight> ring;  ///< of each slot, innermost first
    std::vector<AnnulusLight> gap;   ///< of each gap between them: black in a marker
    double gain = 0, offset = 0;
  };
  /// Nothing where that cannot be told.
  std::optional<RingLights> ring_lights(const cv::Mat& gray, const Fit& fit, const FitOptions& options);

 private:
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;
  struct Equations {
    Matrix normal;
    Vector right;
    double squares = 0, neighbours = 0, weight = 0, grey = 0, grey_squares = 0;  // weighted sums
  };
  Equations equations(std::size_t code, const View& view, const Light& light, double psf_px) const;
  Light light_of(std::size_t code, const View& view, double psf_px) const;

  RingModel& model_;
  Samples samples_;
};

}  // namespace relock::ring
