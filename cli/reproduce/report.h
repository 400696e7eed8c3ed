#pragma once

#include <string>
#include <vector>

#include "cli/reproduce/experiment.h"

namespace relock::reproduction {

/// Marks the titles of findings and plots QUICK, if they are.
void mark_quick(std::vector<Finding>& findings, const Settings& settings);

/// Draws the plots of all findings, as .svg, .pdf and .png; without gnuplot none. Returns the files of each finding,
/// pictures too.
std::vector<std::vector<std::filesystem::path>> write_plots(const std::vector<Finding>& findings,
                                                            const Settings& settings);

/// What is printed: for each finding its title, tables and sentences.
std::string text_of(const std::vector<Finding>& findings);
/// The same, and all figures, to be read by programs. Files stand as seen from settings.out.
std::string json_of(const std::vector<Finding>& findings,
                    const std::vector<std::vector<std::filesystem::path>>& files, const Settings& settings);

}  // namespace relock::reproduction
