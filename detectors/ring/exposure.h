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
enum Unknown { kCentreX, kCentreY, kXX, kXY, kYY, kBlurX, kBlurY, kGain, kOffset, kLeak, kVanishingX, kVanishingY };
constexpr int kUnknowns = 12;
using Gradient = Eigen::Matrix<float, kUnknowns, 1>;

/// What one pixel should show, and how that changes with what is unknown.
struct Prediction {
  float grey = 0;
  float leaked = 0;  ///< part of the exposure in which it saw beyond the sheet
  Gradient gradient;
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

  Prediction at(float x, float y, const Light& light) const;
  /// Only the light of the rings there, in [0, 1].
  float rings_at(float x, float y) const;
  /// Part of the exposure in which the pixel sees beyond the sheet.
  float leaked_at(float x, float y) const;

  /// Farthest from the middle that the pixel's point gets while it moves, in the marker's plane.
  float farthest(float x, float y) const;

 private:
  Exposure(RingModel& model, MovingRings& rings, const View& view, double psf_px);

  struct Local {
    float dx, dy, depth;
    float q[2], u[2];
    float j[2][2];  // dq/dp
    float sigma;    // of lens and pixel along the radius
  };
  Local local(float x, float y) const;
  float farthest(const Local& l) const;
  SweptLight light_of(const RadialProfile& still, const SweptProfile* swept, const Local& l) const;
  Gradient gradient(const Local& l, const SweptLight& s) const;

  const RadialProfile& rings_;
  const RadialProfile& sheet_;
  const SweptProfile* swept_rings_ = nullptr;  // where the movement is long
  const SweptProfile* swept_sheet_ = nullptr;
  float centre_[2], s_[2][2], v_[2], b_[2];
  float psf_;
  float sheet_radius_;
  int samples_;  // of short movements
};

}  // namespace relock::ring
