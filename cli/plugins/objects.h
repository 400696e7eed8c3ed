#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/detector.h"
#include "core/options.h"
#include "core/plugin_abi.h"
#include "core/tracker.h"

// A plug-in's objects, called through its table. `method` is the plug-in's own and stays for ever. What the
// plug-in tells as an error is thrown as an Error.

namespace relock::plugin {

/// Families of the codes that a detector reads.
std::vector<std::string> families(const relock_method& method, const Options& options);

std::unique_ptr<Detector> make_detector(const relock_method& method, const Options& options,
                                        std::uint64_t seed);
/// The same for a method that has `explain`: an ExplainingDetector, if this one shows its stages.
std::unique_ptr<Detector> make_explaining_detector(const relock_method& method, const Options& options,
                                                   std::uint64_t seed);
std::unique_ptr<Tracker> make_tracker(const relock_method& method, const Options& options,
                                      std::uint64_t seed);

}  // namespace relock::plugin
