#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"

namespace relock {

/// What pictures of a recording look like in numbers, over all of its frames.
struct Appearance {
  static constexpr std::size_t kShades = 8;  ///< of grey, 32 levels each

  double mean_gray = 0;      ///< levels of 255
  double gradient_mean = 0;  ///< magnitude of the grey levels' central differences, levels a px
  double gradient_p95 = 0;
  /// Standard deviation of the noise where the picture is of this shade, levels; nothing: hardly any pixel is.
  std::array<std::optional<double>, kShades> noise{};
};

/// Gathers an Appearance picture by picture; memory does not depend on their number.
///
/// Noise is estimated in blocks of 8 px by the mean absolute answer of a mask that no plane and no straight change of slope
/// answers to (Immerkaer 1996, Fast Noise Variance Estimation); texture answers too, so of all blocks of a shade the tenth part
/// with the least is believed (and corrected for being the least). It is what is left after the camera's own processing and JPEG.
class AppearanceGatherer {
 public:
  AppearanceGatherer();
  void add(const Image& picture);
  Appearance result() const;

 private:
  static constexpr std::size_t kGradients = 1024, kNoises = 512;  // of quarter levels; of sixteenths
  std::vector<std::uint64_t> gradients_;
  std::vector<std::uint64_t> noises_;  // of each shade
  double gray_sum_ = 0;
  std::uint64_t inner_ = 0;
};

}  // namespace relock
