#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "cli/reproduce/experiment.h"
#include "cli/runs/folder.h"

namespace relock::reproduction {

// OUT/reproduction-plan.json           says that the folder is one of relock reproduce, and whether of --quick
// OUT/.lock                            held by the program that writes here
// OUT/EXPERIMENT/…                     what was measured, to go on from
// OUT/ID.svg, .pdf, .png               plots and pictures; with --quick, ID-QUICK.svg
// OUT/reproduction.txt, .json          what was printed, and all its figures

/// Makes `settings.out` ready and locks it. Throws Error when it holds something else, belongs to the other mode, or
/// another program writes into it.
ResultsLock prepare_reproduction(const Settings& settings);

/// The n-th file, from 0, of a figure or table: OUT/figure-11.svg, OUT/figure-11-2.svg; with --quick
/// OUT/figure-11-QUICK.svg. `ending`: ".svg"
std::filesystem::path file_of(const Settings& settings, const std::string& id, std::size_t n,
                              std::string_view ending);

}  // namespace relock::reproduction
