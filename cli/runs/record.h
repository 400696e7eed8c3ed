#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/replay/multistart.h"
#include "eval/replay/replay.h"

namespace relock {

/// How a method was shown a recording.
struct Showing {
  Protocol protocol = Protocol::once;
  std::optional<Anchor> anchor;  ///< protocol multistart
  std::string real_time;  ///< which frames waited for a busy method; empty: it had all the time it wanted
  std::string latency;    ///< then, of its answers
  friend auto operator<=>(const Showing&, const Showing&) = default;
};
/// "protocol once, real time latest, latency constant(20ms)", "protocol multistart from frame 50 backward": for
/// headings.
std::string spoken(const Showing& showing);

/// What produced a run, and how it went: run.json.
struct RunRecord {
  // What went in. A run with the same of these is not run again.
  std::string relock_version;
  std::string program;  ///< fingerprint of the program itself
  std::string opencv_version;
  std::string recording;                       ///< its name
  std::string fingerprint;                     ///< of its pictures, times and labels
  std::string method;                          ///< as it would be typed
  std::map<std::string, std::string> options;  ///< of the method, defaults too
  std::string gaps;                            ///< pattern, "none" as recorded
  std::vector<FrameIndex> dropped;             ///< frames that the pattern took, counted as recorded
  std::uint64_t seed = 1;
  Protocol protocol = Protocol::once;
  std::optional<Anchor> anchor;  ///< protocol multistart; frames of a backward run are counted as played
  std::string gate;              ///< by which protocol reset judged losses; empty otherwise

  std::string real_time;  ///< which frames wait for a busy method; empty: it had all the time it wanted
  std::string latency;    ///< then, of its answers

  // What it was.
  bool yardstick = false;
  bool reads_codes = false;
  bool deterministic = true;
  // How it went.
  std::vector<std::optional<FrameIndex>> judged_from;  ///< for each target
  std::vector<std::optional<FrameIndex>> failed_from;  ///< for each target
  std::vector<Failure> failures;
  std::optional<Failure> cut_short;  ///< the recording could not be read on from there

  bool same_inputs(const RunRecord& other) const;
  /// Whether `relock import` made it of another toolkit's result files: its program is "imported" and their
  /// fingerprints.
  bool imported() const { return program.starts_with("imported "); }
  Showing showing() const { return {protocol, anchor, real_time, latency}; }
  /// Whether both may stand in one table: the same inputs but for the method and the program.
  bool same_conditions(const RunRecord& other) const;
};

/// run.json, as text and back.
std::string to_json_text(const RunRecord& record);
/// `name` is what errors call the text. Throws Error when it is no run.json of this relock.
RunRecord parse_record(const std::string& text, const std::string& name);
/// Throws Error naming the file when it is no run.json of this relock.
RunRecord read_record(const std::filesystem::path& path);

}  // namespace relock
