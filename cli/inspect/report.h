#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/inspection/inspection.h"
#include "sequences/open.h"

namespace relock {

/// Blur estimates of a recording (eval/inspection/blur_estimate.h).
struct BlurReport {
  std::vector<BlurOfFrame> picture;               ///< of whole pictures
  std::vector<std::vector<BlurOfFrame>> targets;  ///< of each target where it is visible
};

/// Everything that `relock inspect` tells of a recording.
struct InspectReport {
  Sequence sequence;
  Inspection inspection;
  std::optional<BlurReport> blur;             ///< nothing: pictures were not read
  std::optional<std::string> pictures_fault;  ///< why they could not be read to the end
};

/// What a recording is fit for, or where it ends.
struct Remark {
  enum class Kind : std::uint8_t { fit, limit };
  Kind kind = Kind::limit;
  std::string sentence;
};
/// By the rules and numbers at the top of cli/inspect/fitness.cpp; what it is fit for comes first.
std::vector<Remark> remarks(const InspectReport& report);

/// Keys are described in docs/inspecting.md.
std::string inspect_json(const InspectReport& report);
std::string inspect_text(const InspectReport& report);

}  // namespace relock
