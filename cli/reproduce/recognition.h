#pragma once

#include "cli/reproduce/experiment.h"

namespace relock::reproduction {

/// The paper's section 3.1: square markers of 150 px, blurred along straight lines.
std::vector<Finding> figure_3(const Settings& settings, const Methods& methods);

/// The paper's section 4.1: the same for rings, by code, and square ones beside them.
std::vector<Finding> figure_11(const Settings& settings, const Methods& methods);

}  // namespace relock::reproduction
