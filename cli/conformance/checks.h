#pragma once

#include <chrono>
#include <string_view>
#include <vector>

#include "cli/conformance/subject.h"

// What is asked of methods. Each check is a function that shows things to a method in a child process and
// fails, by its Stage, at the first answer that is not as promised (core/tracker.h, core/detector.h).

namespace relock {

/// How long the long check may take.
struct MemoryLimits {
  int frames = 10'000;
  std::chrono::nanoseconds budget = std::chrono::seconds(60);
};

/// What a check says when it passed: a note for the table, often empty.
using Note = std::string;

struct Check {
  std::string_view name;
  Note (*work)(const Subject&, const MemoryLimits&, Stage&);
  bool twice = false;  ///< in two processes, whose answers must be equal
};

/// A check that cannot be asked of this subject throws one of these, with the reason.
class NotAsked : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// In the order in which they are made.
std::vector<Check> entry_checks();     ///< of what the entry says: both kinds
std::vector<Check> tracker_checks();   ///< what only trackers promise
std::vector<Check> detector_checks();  ///< what only detectors promise
std::vector<Check> film_checks();      ///< hard films: both kinds
std::vector<Check> pixel_checks();     ///< how it handles the pixels it is given: both kinds
std::vector<Check> session_checks();   ///< repeated, beside others, for long: both kinds

}  // namespace relock
