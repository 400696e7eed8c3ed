#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/comparison.h"
#include "cli/flights.h"
#include "cli/reproduce/experiment.h"

// Methods run on recordings of an experiment, and their runs read back and judged.

namespace relock::reproduction {

/// Runs those of `wanted` that there are on every recording, by `protocol`, into OUT/runs, and reads and judges all of it,
/// recording by recording. What is there already is kept. Throws Error when none of the methods is known, and when the
/// runs are not complete: after an interrupt, say.
std::vector<ScoredComparison> run_on(const Settings& settings,
                                     const std::vector<std::filesystem::path>& recordings,
                                     const std::vector<std::string>& wanted, Protocol protocol,
                                     const Methods& methods);

/// Flies what is missing into OUT/flights, and runs methods on it by protocol detect.
std::vector<ScoredComparison> fly_and_run(const Settings& settings, const std::vector<NamedFlight>& flights,
                                          const std::vector<std::string>& wanted, const Methods& methods);

}  // namespace relock::reproduction
