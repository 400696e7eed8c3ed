#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace relock {

/// Templates and looks as a particle filter has them, from recordings/klahaag: 20 x 20 samples of mean 0 and
/// length 1.
struct Looks {
  Eigen::MatrixXf
      dictionary;           ///< 10 sharp templates jittered by a pixel, the blurred ones, the first one again
  Eigen::VectorXf weights;  ///< one for each
  Eigen::MatrixXf looks;    ///< a column each
};

/// The shirt's first look, blurred along `directions` by `lengths` (0.05 to 0.4 of its width), and what
/// particles within about `spread` widths of it see in later frames, every other one of which is blurred by
/// up to half a width. Looks are ordered as a filter's would be: frame by frame.
Looks shirt_looks(int count, std::uint64_t seed, int directions = 8, int lengths = 8, double spread = 0.12);

/// Looks and templates that are noise, some looks being mixtures of templates with noise or with a part
/// hidden.
Looks random_looks(int count, std::uint64_t seed, int templates = 75);

}  // namespace relock
