#pragma once

#include <memory>

#include "core/compose.h"

namespace relock {

/// Looks for the pixels that were at the place remembered last, by their normalised correlation. Scale and
/// turn are not searched: they change little over a gap.
std::unique_ptr<Searcher> patch_searcher();

}  // namespace relock
