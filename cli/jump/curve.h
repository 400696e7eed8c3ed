#pragma once

#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/jump/attempt.h"
#include "cli/plot/plot.h"

namespace relock::jumps {

/// Jumps of one method within one bin of displacement. Jumps are of different windows, so that the interval is Wilson's
/// (docs/metrics.md section 6).
struct LossRate {
  int tried = 0;  ///< jumps before which the target was held
  int lost = 0, declared = 0, failed = 0;
  int not_held = 0;  ///< further jumps, before which it was not

  Interval interval() const;  ///< of lost / tried, %
};

/// The jump curve of a method.
struct Curve {
  std::string method;
  std::vector<LossRate> bins;
};

/// One for each method, over all recordings.
std::vector<Curve> curves_of(const Trial& trial, const Outcomes& outcomes);

/// A row for each bin, a column for each method: "50 [31, 69] of 24", and below what was said of the losses.
std::string text_of(const std::vector<Curve>& curves, const Trial& trial);
Json json_of(const std::vector<Curve>& curves, const Trial& trial);
Plot plot_of(const std::vector<Curve>& curves, const Trial& trial);

}  // namespace relock::jumps
