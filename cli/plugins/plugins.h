#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/program.h"

namespace relock {

// Plug-ins are shared libraries that bring methods (docs/adding-a-detector.md, core/plugin.h). They are looked
// for in this order: what --plugin names; what RELOCK_PLUGINS names, separated by colons; and the folder
// $XDG_DATA_HOME/relock/plugins, which is ~/.local/share/relock/plugins where that variable is not set. A
// folder stands for all *.so in it.

/// A plug-in that could not be used.
struct LeftOut {
  std::filesystem::path file;
  std::string why;         ///< one clause
  bool asked_for = false;  ///< by --plugin
};

/// Adds the methods of all plug-ins to `methods`; `asked`: what --plugin names. Each is first loaded in a
/// child process, so that one that crashes or hangs is left out like any other that is at fault.
std::vector<LeftOut> add_plugins(Methods& methods, const std::vector<std::filesystem::path>& asked);

}  // namespace relock
