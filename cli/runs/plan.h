#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/method_spec.h"
#include "eval/replay/replay.h"
#include "sequences/open.h"

namespace relock {

/// A recording that a plan names, and how to open it.
struct PlannedSequence {
  std::filesystem::path path;
  OpenOptions open = {};
};

/// What a run may take before it counts as failed.
struct RunLimits {
  double frame_s = 60;      ///< to answer about one frame, starts and decoding included, s
  double memory_mb = 4096;  ///< to allocate beyond what the program has when the run begins, MB
};

/// What is to be run: every method on every sequence, with every gap pattern, by every protocol, with every
/// seed. As a file (TOML; paths are relative to it):
///
///     sequences = ["flights/a", "flights/b.mp4"]      # or tables, for more than the path:
///     # [[sequence]]
///     # path = "flights/a"
///     # labels = "labels/a.csv"                       # likewise rate_hz, format, topic
///     methods = ["kcf", "csrt(psr_threshold=0.05)"]
///     gaps = ["none", "paper", "bernoulli(0.1)"]      # else as recorded
///     protocols = ["once", "reset"]                   # else once
///     paired = true                                   # as recorded, too: what do the gaps cost?
///     seeds = [1, 2, 3]                               # else 1
///     gate = "centre"                                 # by which protocol reset judges losses
///     real_time = "latest"                            # or "queue(3)"; else a method may take all the time it wants
///     latency = "constant(20ms)"                      # or a file (columns frame, wall_ms); else measured
///     out = "results"
///     frame_limit_s = 60
///     memory_limit_mb = 4096
struct Plan {
  std::vector<PlannedSequence> sequences;
  std::vector<MethodSpec> methods;
  std::vector<std::string> gaps{"none"};
  std::vector<Protocol> protocols{Protocol::once};
  std::vector<std::uint64_t> seeds{1};
  Gate gate = {};
  bool paired = false;  ///< `gaps` holds "none", too, and the arms are compared
  std::optional<RealTime> real_time = {};
  std::filesystem::path out = "results";
  RunLimits limits = {};
};

/// Makes a paired gap experiment of a plan: every gap pattern is compared with what was recorded. Throws Error
/// when the plan has no pattern.
void pair_up(Plan& plan);

/// `waiting` and `latency` as they are typed; a latency that is neither measured nor constant is the path of a file.
/// Throws Error when they are none.
RealTime parse_real_time(const std::string& waiting, const std::string& latency);

/// Throws Error with file, line and column.
Plan read_plan(const std::filesystem::path& file);

}  // namespace relock
