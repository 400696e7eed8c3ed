#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/recording.h"
#include "eval/replay/real_time.h"

namespace relock {

// answers.csv: when the answers of a run in real time were there, on the recording's clock. Columns:
//   frame        that was answered
//   arrival_ns   its capture time
//   finished_ns  when the answer was there
// In order of frames. With trajectory.csv it is all that scores of real time are made of.

void write_answers(std::ostream& out, const std::vector<Answer>& answers);
/// Throws Error with file and line on a frame out of order, a time that is not the recording's, or an answer that is
/// there before its frame or before the answer to an earlier one.
std::vector<Answer> read_answers(std::istream& in, const std::string& file, const Recording& recording);

/// Latencies frame by frame: columns frame and wall_ms, as timing.csv has them; other columns are left alone. Throws
/// Error with file and line on a frame out of order, a time below zero, and when there is none.
Latency read_latencies(std::istream& in, const std::string& file);

}  // namespace relock
