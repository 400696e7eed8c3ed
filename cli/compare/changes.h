#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arms.h"
#include "cli/compare/run_pairs.h"
#include "cli/runs/folder.h"
#include "eval/judgement/loss_changes.h"

namespace relock {

// What changed between two result folders, A (before) and B (after): docs/compare.md.

/// What two folders are compared in. All but the last are told with an interval.
enum class ComparedScore : std::uint8_t {
  recognition,
  precision,
  availability,
  locked_share,
  losses_per_minute,  ///< of locked time
  error_px,           ///< median position error over Hits of both on the same frame
  losses,             ///< their number
};
constexpr std::size_t kComparedScores = 7;
/// As --fail-if and JSON call it: "locked-share".
std::string_view name_of(ComparedScore score);
bool more_is_better(ComparedScore score);
bool has_interval(ComparedScore score);

/// One score in both folders, over the runs that both have. An empty value is n/a.
struct ScoreChange {
  std::optional<double> before, after;
  std::optional<double> difference;  ///< B - A; of error_px the median of the frames' differences
  std::optional<Interval> interval;  ///< 95 %, of the difference; frames stay paired
};
/// What the interval of a difference says: -1 worse, 1 better, 0 nothing (it holds zero, or there is none).
int verdict_on(ComparedScore score, const std::optional<Interval>& difference);

/// A loss in one folder or in both.
struct ChangedLoss {
  std::string recording, target;
  std::uint64_t seed = 1;
  std::optional<Anchor> anchor;  ///< protocol multistart
  LossChange change;
  std::string where;  ///< what tells its run from the others: "klahaag, target shirt, seed 2"
  std::string text;   ///< the loss in words, as B has it, else A
  std::optional<double> onset_before_s, onset_after_s;  ///< early end, from the first recorded frame
};

/// What became of one method.
struct MethodChange {
  std::string method;       ///< in A
  std::string method_in_b;  ///< the same, unless another was asked for
  bool deterministic = true;
  std::size_t runs = 0;       ///< in both folders; those that say the same on the same are counted once
  std::size_t same_runs = 0;  ///< of them, those that say the same in A and B
  double label_sigma_px = 0;  ///< RMS accuracy of the labels behind error_px; 0: exact
  std::array<ScoreChange, kComparedScores> scores;  ///< by ComparedScore
  std::vector<ChangedLoss> losses;                  ///< all, kept ones too; by run, in order of time

  const ScoreChange& operator[](ComparedScore score) const { return scores[static_cast<std::size_t>(score)]; }
  std::size_t count(LossFate fate) const;
  bool same() const { return runs == same_runs; }
};

/// Runs that were made and are judged alike, but for recording, seed and anchor.
struct ConditionsChange : PairedConditions {
  std::vector<MethodChange> methods;  ///< as they stand in A
};

struct FolderChange {
  std::vector<ConditionsChange> groups;
  std::vector<std::string> only_in_a, only_in_b;  ///< in words: "method csrt (2 runs)"
  std::vector<std::string> left_out;              ///< what both have, and cannot be compared: why
};

/// Pairs the runs of `a` and `b` that have the same recording (pictures, times and labels), method as typed, gaps,
/// seed, protocol, anchor, real time and latency. `methods`: only these. Yardsticks are compared where nothing else is. `gate`: else the one
/// by which resets were judged, else centre. Throws Error when the
/// two have no run in common, or one has a run twice.
FolderChange changes(const std::vector<StoredComparison>& a, const std::vector<StoredComparison>& b,
                     const std::optional<std::string>& gate, const std::vector<MethodPair>& methods = {});

/// For people, and as JSON. `a` and `b`: how the folders are called.
struct FolderNames {
  std::string a, b;
};
std::string changes_text(const FolderChange& change, const FolderNames& names);
Json changes_json(const FolderChange& change, const FolderNames& names);

}  // namespace relock
