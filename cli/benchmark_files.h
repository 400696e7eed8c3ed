#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording.h"
#include "eval/compatibility/answers.h"
#include "eval/compatibility/vot.h"
#include "eval/replay/replay.h"

namespace relock {

// Result files of other toolkits, docs/compatibility.md. In each, one line for each frame:
//   otb     METHOD/SEQUENCE.txt                        x,y,w,h with 1-based pixels; no answer: 0,0,0,0
//   got10k  METHOD/SEQUENCE/SEQUENCE_001.txt           the same
//   vot     METHOD/baseline/SEQUENCE/SEQUENCE_001.txt  1 where started, 2 where failed, 0 up to the next start,
//                                                      else a box x,y,w,h or a polygon x1,y1,…, from the corner
//   tum     METHOD/SEQUENCE.txt                        timestamp tx ty tz qx qy qz qw; no answer: no line
// and how long each frame took, in seconds: METHOD/times/SEQUENCE_time.txt, SEQUENCE_time.txt and
// SEQUENCE_001_time.value.

enum class ResultFormat : std::uint8_t { vot, otb, got10k, tum };
std::string_view to_string(ResultFormat format);
/// Throws Error when `text` is none of them.
ResultFormat parse_result_format(std::string_view text);

/// Whether runs of a protocol are what the format's toolkit scores: `vot` is for supervised runs, otb and
/// got10k for those that are started once or not at all, tum for any that goes through the recording once.
bool fits(ResultFormat format, Protocol protocol);

/// Where the results of a method on a sequence belong below the output folder.
std::filesystem::path result_path(ResultFormat format, const std::string& method,
                                  const std::string& sequence);
/// Where its times belong; nothing for tum.
std::optional<std::filesystem::path> times_path(ResultFormat format, const std::string& method,
                                                const std::string& sequence);

/// The file's text; pixels have four decimals. Of outlines that the format does not have, the box around them.
std::string result_text(ResultFormat format, const AnsweredSequence& sequence, const Recording& recording);
/// tum: the truth, to compare with.
std::string tum_truth(const AnsweredSequence& sequence, const Recording& recording);

/// What a result file says of a frame.
struct ForeignAnswer {
  VotCode code = VotCode::region;  ///< otb and got10k know only regions
  std::optional<Outline> outline;  ///< nothing with another code, and where a box has no size or is NaN
};
/// One line for each frame. Throws Error with file and line on what is no line of the format.
std::vector<ForeignAnswer> read_answers(ResultFormat format, const std::filesystem::path& file);

}  // namespace relock
