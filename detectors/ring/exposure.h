#pragma once

#include <Eigen/Core>

#include "detectors/ring/ring_model.h"
#include "detectors/ring/view.h"

// What a pixel sees of a moving marker: the generative picture, equation by equation.
//
//     I(p) = offset + gain mean_t P(|q + t u|) + leak (1 - mean_t B(|q + t u|)),     t from -1/2 to 1/2
//
// q is the pixel's point in the marker's plane and u its movement there, P the rings' profile as the lens shows
// it, B the black sheet's.

namespace relock::ring {

/// Brightness of a marker in a picture, grey levels.
struct Light {
  double offset = 0;  ///< of black
  double gain = 0;    ///< of white above black
  double leak = 0;    ///< of what is around the sheet, on average, above black
};

/// The numbers that a fit may change, in the order of its equations.
enum Unknown {
  kCentreX,
  kCentreY,
  kXX,
  kXY,
  kYY,
  kBlurX,
  kBlurY,
  kGain,
  kOffset,
  kLeak,
  kVanishingX,
  kVanishingY
};
constexpr int kUnknowns = 12;

/// What the pixels of a block should show, and how that changes with what is unknown.
struct Prediction {
  alignas(32) Row grey;
  alignas(32) Row leaked;               ///< part of the exposure in which a pixel sees beyond the sheet
  alignas(32) Row gradient[kUnknowns];  ///< of grey
};

/// Predicts pixels of one view: what they have in common is worked out once.
class Exposure {
 public:
  /// `psf_px`: standard deviation of lens and pixel together, px of this picture.
  Exposure(RingModel& model, std::size_t code, const View& view, double psf_px)
      : Exposure(model, model.code(code), view, psf_px) {}
  /// Of one ring by itself.
  static Exposure of_slot(RingModel& model, std::size_t slot, const View& view, double psf_px) {
    return Exposure(model, model.slot(slot), view, psf_px);
  }
  /// Of one gap between rings by itself.
  static Exposure of_gap(RingModel& model, std::size_t gap, const View& view, double psf_px) {
    return Exposure(model, model.gap(gap), view, psf_px);
  }

  // Each for `n` pixels, at most kBlock.

  void predict(const float* x, const float* y, int n, const Light& light, Prediction& out) const;
  /// Only the light of the rings, in [0, 1].
  void rings(const float* x, const float* y, int n, float* light) const;
  /// Only the part of the exposure in which a pixel sees beyond the sheet.
  void leaked(const float* x, const float* y, int n, float* part) const;

 private:
  Exposure(RingModel& model, MovingRings& rings, const View& view, double psf_px);

  struct Places;
  void place(const float* x, const float* y, int n, Places& out) const;
  void light_of(const RadialProfile& still, const SweptProfile* swept, const Places& places, int n,
                SweptLight& out) const;
  bool any_near_edge(const Places& places, int n) const;
  /// The gradients of the light by what moves the pixels' points, of those by the points.
  static void chain(const Places& places, const SweptLight& light, const float* v, const float* b, int n,
                    Row* gradient);

  const RadialProfile& rings_;
  const RadialProfile& sheet_;
  const SweptProfile* swept_rings_ = nullptr;  // where the movement is long
  const SweptProfile* swept_sheet_ = nullptr;
  float centre_[2], s_[3], v_[2], b_[2];  // S: xx, xy, yy
  float psf_;
  float sheet_radius_;
  int samples_;  // of short movements
};

}  // namespace relock::ring
