#pragma once

#include "cli/reproduce/canvas_answers.h"
#include "cli/reproduce/experiment.h"

namespace relock::reproduction {

/// Errors of the centre, over pictures on which the marker was recognised.
struct CentreErrors {
  int pictures = 0;                    ///< shown
  int recognised = 0;                  ///< of them
  std::optional<double> mean_px;       ///< distance from the true centre
  std::optional<double> deviation_px;  ///< its standard deviation
  std::optional<Interval> interval;    ///< of the mean, by Student's t: the pictures are independent
  std::optional<double> along_px;      ///< RMS of the part along the blur
  std::optional<double> across_px;     ///< RMS of the part across it
};
CentreErrors centre_errors(const std::vector<PictureAnswer>& answers);

/// The paper's section 4.1: how exactly the centre is found, by angle of the blur.
std::vector<Finding> table_1(const Settings& settings, const Methods& methods);

}  // namespace relock::reproduction
