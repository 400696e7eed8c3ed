#pragma once

#include <cstddef>
#include <functional>

namespace relock {

/// Does something about one of the things that there are.
using Work = std::function<void(std::size_t index)>;

/// Works on 0 … count - 1 in `jobs` threads. Every thread makes its own worker, with what it must not share. What
/// they do is done in any order, so each index writes only what is its own. The first exception ends the work and is
/// thrown on.
void in_parallel(std::size_t count, int jobs, const std::function<Work()>& make_worker);

}  // namespace relock
