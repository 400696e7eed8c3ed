#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/comparison.h"
#include "cli/runs/copies.h"
#include "eval/scores/in_force.h"
#include "eval/statistics/ratio.h"

namespace relock {

/// What has a table of its own, within the runs that may stand in one.
enum class Grouping : std::uint8_t { none, recording, target, code, blur, gap };
/// "recording", "target", "code", "blur" or "gap". Throws Error otherwise.
Grouping parse_grouping(std::string_view text);
std::string_view to_string(Grouping grouping);

/// Everything one method did in the runs of a table.
struct MethodPool {
  std::string method;
  bool yardstick = false;
  bool deterministic = true;
  std::size_t runs = 0;
  Tally tally;
  std::vector<FrameCost> costs;  ///< of every frame it was asked about, where they are asked for
  RealTimeScores real_time;      ///< of runs made in real time
  std::vector<Fix> common;       ///< Hits common to all methods asked about the target, yardsticks apart
  /// What each frame of each recording added, over all runs on it: one element where frames are not kept apart.
  std::map<std::string, std::vector<Contribution>> frames;
  std::map<std::string, std::vector<FramedValue>> errors_px;  ///< of the Hits on each recording
  /// Recording, target, and which of its frames were shown from where: the same for seeds that drop the same.
  std::set<std::tuple<std::string, std::string, std::string>> scored_on;
  /// On how many recordings' targets.
  std::size_t targets() const;
  std::vector<Failure> failures;  ///< the first of each run that failed
};

/// What the runs of one table have in common.
struct TableConditions {
  std::string protocol;
  std::string gaps;  ///< pattern, "none" as recorded
  std::string gate;
  std::string real_time;  ///< which frames waited for a busy method; empty: it had all the time it wanted
  std::string latency;
  friend auto operator<=>(const TableConditions&, const TableConditions&) = default;
};

/// What may stand in one table: the same conditions, over all recordings, seeds and anchors.
struct ScoreTable {
  TableConditions conditions;
  Grouping grouping = Grouping::none;
  std::string group;  ///< which recording, target, code or bin; empty: all of them
  std::set<std::string> recordings;
  std::set<std::uint64_t> seeds;
  std::set<std::string> starts;     ///< protocol multistart: "frame 50 backward"
  std::vector<MethodPool> methods;  ///< by name, yardsticks last

  /// How many targets methods were scored on, over all recordings.
  std::size_t targets() const;
};

/// From this many recordings on, intervals rest on recordings as units.
constexpr std::size_t kRecordingsToResample = 10;

/// Adds up the runs of many comparisons, one at a time.
class ScorePool {
 public:
  /// `recordings`: how many there will be. Where intervals rest on recordings, frames are not kept apart.
  ScorePool(Grouping grouping, std::size_t recordings) : grouping_(grouping), recordings_(recordings) {}

  void add(const ScoredComparison& compared);
  /// What the runs of a comparison that was added cost, run by run.
  void add_costs(const ScoredComparison& compared, const std::vector<std::vector<FrameCost>>& costs);
  /// In order of their conditions and groups.
  std::vector<ScoreTable> tables() &&;

 private:
  /// One target, or a bin of its frames, and the table that it goes into.
  struct Part {
    std::string group;
    std::size_t target = 0;
    std::optional<std::size_t> bin = {};
  };
  std::vector<Part> parts_of(const Recording& recording) const;
  ScoreTable& table_of(const ScoredComparison& compared, const Part& part);
  void add_part(const ScoredComparison& compared, std::size_t run, const Part& part, MethodPool& pool) const;
  void add_what_is_of_all_targets(const ScoredComparison& compared, std::size_t run, MethodPool& pool) const;
  void add_frames(const ScoredComparison& compared, std::size_t run, const std::vector<Contribution>& frames,
                  MethodPool& pool) const;

  Grouping grouping_;
  std::size_t recordings_;
  KnownRuns known_;
  /// By conditions, order of the group, and group.
  std::map<std::tuple<TableConditions, std::size_t, std::string>, ScoreTable> tables_;
};

}  // namespace relock
