#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/runs/folder.h"

namespace relock {

/// A run that two result folders have. Points into what it was found in.
struct RunPair {
  const StoredComparison* comparison;  ///< of the first folder: its truth is that of both
  const StoredRun *before, *after;
};

/// A method of the first folder and the one of the second that it is compared with, names as typed.
struct MethodPair {
  std::string before, after;
};
/// "kcf=kcf(detect_thresh=0.4)": apart at the first = outside parentheses. Throws Error when it is not two names.
MethodPair parse_method_pair(std::string_view text);

/// Who is in both folders, and who is not.
struct RunPairs {
  std::vector<RunPair> pairs;                     ///< in the order of the first folder
  std::vector<std::string> only_in_a, only_in_b;  ///< in words
  std::vector<std::string> left_out;              ///< in both, and not to be compared: why
};

/// As for changes() (cli/compare/changes.h). Copies, runs that say the same under another seed in both folders, count
/// once. `methods`: only these, else every method with that of the same name. Throws Error when there is no pair, a
/// folder has a run twice, or not the method that is named.
RunPairs run_pairs(const std::vector<StoredComparison>& a, const std::vector<StoredComparison>& b,
                   const std::vector<MethodPair>& methods = {});

}  // namespace relock
