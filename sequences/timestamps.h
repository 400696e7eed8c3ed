#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace relock {

// timestamps.csv: a header, then one row for each recorded frame, in order. Columns:
//   timestamp_ns   capture time, whole nanoseconds from any epoch
//   frame          rank of the frame, for the reader's convenience; not looked at
//   file           name of the frame's picture; may be left out: pictures are then taken in order of name

struct Timestamps {
  std::vector<Time> captured;
  std::vector<std::string> files;  ///< empty when the file does not name them
};

/// Throws Error with file and line on a time that repeats, goes backwards or jumps by more than a day.
Timestamps read_timestamps(std::istream& in, const std::string& file);
Timestamps read_timestamps(const std::filesystem::path& path);

/// What is wrong with `captured` behind the times before it (it repeats, goes backwards, jumps by more than a
/// day); empty if nothing is.
std::string fault_of_time(const std::vector<Time>& before, Time captured);

/// A time in decimal seconds ("1305031102.175304") to the nanosecond, digit by digit: a double would lose
/// some. Throws Error at the place in the file on anything else, or on what is finer than a nanosecond.
Time time_of_seconds(std::string_view text, const std::string& file, std::size_t line);

void write_timestamps(std::ostream& out, const std::vector<Time>& captured);

}  // namespace relock
