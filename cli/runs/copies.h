#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "cli/runs/folder.h"

namespace relock {

// What must not be counted twice, or together, when runs of many folders are put into one table.

/// Of what a run said when: places are to a ten-thousandth of a pixel, so that answers that agree in all of them are
/// the same answers.
std::uint64_t hash_of_answers(const StoredRun& run);

/// Runs that say the same of the same frames are one experiment, however often it was made: under several seeds
/// where nothing was drawn, or in two folders.
class KnownRuns {
 public:
  /// Whether no copy of this run has been shown before. Copies have the same method, recording, gap pattern, protocol
  /// and gate, and say the same.
  bool first(const StoredRun& run, const Gate& judged_by);

 private:
  using Key =
      std::tuple<std::string, std::string, std::string, std::string, Showing, std::string, std::uint64_t>;
  std::set<Key> known_;
};

/// Recordings are told apart by name.
class KnownRecordings {
 public:
  /// Throws Error when another recording of this name has been shown before.
  void check(const StoredComparison& comparison);

 private:
  struct Known {
    std::string fingerprint;
    std::string folder;
  };
  std::map<std::string, Known> known_;  // by name
};

}  // namespace relock
