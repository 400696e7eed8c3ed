#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/compare/changes.h"

namespace relock {

/// What `relock compare --fail-if` holds against a change: "availability drops > 0.02",
/// "kcf: losses rises > 0", "recognition drops > 0.01 surely".
///
///     [METHOD:] METRIC drops|rises > NUMBER [surely]
///
/// Metrics are those of name_of(ComparedScore); shares are of 1. Without a method it is held against every one.
struct FailCondition {
  std::string text;  ///< as it was given
  std::optional<std::string> method;
  ComparedScore score = ComparedScore::availability;
  bool rises = false;
  double by = 0;
  bool surely = false;  ///< the whole interval of the difference is beyond `by`, not its middle alone
};
/// Throws Error that points at the character.
FailCondition parse_fail_if(std::string_view text);

/// What was found of a condition.
struct Finding {
  FailCondition condition;
  std::vector<std::string> because;  ///< it holds: "kcf, as recorded: availability drops by 0.034"
  std::vector<std::string> unsure;   ///< "surely" was asked for, and the data tell no interval
  std::vector<std::string> unknown;  ///< where it cannot be told: the score is n/a in one of the folders
};
/// Throws Error when the condition's method is not compared.
Finding check(const FailCondition& condition, const FolderChange& change);

}  // namespace relock
