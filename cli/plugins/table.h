#pragma once

#include "cli/program.h"
#include "core/plugin_abi.h"

namespace relock {

/// The methods of a plug-in's table, as entries that work like those built in. The table must stay.
/// Throws Error when the table is null, of another version, or at odds with core/plugin_abi.h.
Methods methods_of(const relock_plugin* table, const PluginFile& file);

}  // namespace relock
