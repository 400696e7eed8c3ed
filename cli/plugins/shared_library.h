#pragma once

#include <filesystem>

#include "core/plugin_abi.h"

// A plug-in's file: what can be said of it before its code runs, and loading it.

namespace relock {

/// Throws Error when the file is missing, is no shared library of this kind of machine, or asks for another
/// OpenCV than this program's: two of them in one process call each other's functions.
void check_shared_library(const std::filesystem::path& file);

/// Loads a shared library for good and asks it for its table, which may be null. Throws Error when it cannot
/// be loaded or is no plug-in. Its code runs here: a bad one crashes or hangs (cli/plugins/plugins.h tries it in a
/// child first).
const relock_plugin* load_plugin(const std::filesystem::path& file);

}  // namespace relock
