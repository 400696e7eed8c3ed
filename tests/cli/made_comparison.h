#pragma once

#include <string>
#include <vector>

#include "cli/comparison.h"
#include "cli/scores/pool.h"
#include "cli/scores/tables.h"

namespace relock {

/// What one method said of each target, one letter a frame: H where it is, S somewhere else, M nothing, . never came.
struct MadeRun {
  std::string method;
  std::vector<std::string> targets;
  bool yardstick = false;
};

/// How runs were made.
struct MadeConditions {
  std::string gaps = "none";
  std::uint64_t seed = 1;
  Protocol protocol = Protocol::once;
  std::optional<Anchor> anchor = {};
  std::string real_time = {};
  std::string latency = {};
};

/// Targets that are always visible at 30 Hz, the first with a code and blurred more and more.
StoredComparison made_comparison(const std::string& recording, const std::vector<MadeRun>& runs,
                                 const MadeConditions& conditions = {});

/// As many letters, H but for M in outages of `length` frames: the n-th begins at n * `every` + `from`, moved on by
/// up to four frames, so that they are not regular.
std::string with_outages(std::size_t frames, std::size_t every, std::size_t length, std::size_t from = 7);

/// Judged by `gate` and pooled.
std::vector<ScoreTable> pooled_tables(const std::vector<StoredComparison>& all,
                                      Grouping grouping = Grouping::none, const Gate& gate = {});
std::vector<JudgedTable> judged_tables(const std::vector<StoredComparison>& all,
                                       Grouping grouping = Grouping::none);

}  // namespace relock
