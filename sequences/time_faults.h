#pragma once

#include <filesystem>
#include <vector>

#include "core/time.h"

namespace relock {

/// A capture time that does not rise.
struct TimeFault {
  std::size_t line = 0;  ///< of the file, from 1
  Time time;
  Time before;  ///< of the row before: equal to `time`, or later
};

/// All times of a timestamps.csv that repeat or go backwards: what `read_timestamps` refuses at the first.
/// Empty when there is no such file. Throws Error on what is no timestamps.csv at all.
std::vector<TimeFault> time_faults(const std::filesystem::path& timestamps_csv);

}  // namespace relock
