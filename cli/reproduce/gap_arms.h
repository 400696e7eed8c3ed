#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/recording.h"
#include "sequences/gaps.h"

// What a gap does is two things at once: time passes without a picture, and the target is elsewhere afterwards. Taken
// apart: one flight of which every frame arrived is made into recordings with the one, the other, both or neither.

namespace relock::reproduction {

enum class GapArm : std::uint8_t {
  all_frames,  ///< every frame, at the camera's pace
  pauses,  ///< every frame, and the clock stands still for the length of a gap: time passes, nothing jumps
  jumps,   ///< frames missing as by gaps, the clock closed up: the target jumps, no time passes
  gaps,    ///< frames missing, at their true times: time passes and the target jumps
};
constexpr std::array<GapArm, 4> kGapArms{GapArm::all_frames, GapArm::pauses, GapArm::jumps, GapArm::gaps};
/// "all frames", "pauses", "jumps", "gaps"
std::string_view to_string(GapArm arm);
bool jumps(GapArm arm);   ///< the target, by more than from frame to frame
bool pauses(GapArm arm);  ///< the clock, by more than the period

/// Which frames of a flight are shown, and the times that they are said to be of.
struct Cut {
  std::vector<FrameIndex> frames;
  std::vector<Time> captured;  ///< as many
};
/// `captured`: of a flight without a gap, at an even pace. The n-th interval is of as many slots in `pauses` as in
/// `gaps`, and the frames of `jumps` are those of `gaps`.
Cut cut(GapArm arm, std::span<const Time> captured, Duration period, const GapPattern& pattern,
        std::uint64_t seed);

/// The truth of a cut, called `name`.
Recording cut_recording(const Recording& flight, const Cut& cut, const std::string& name);

/// Writes the recording `out`, whole or not at all, with the pictures of the flight that lies beside it. Nothing is
/// done when it is there already. Throws Error when it cannot be written.
void write_cut(const std::filesystem::path& flight, const Recording& truth, const Cut& cut,
               const std::filesystem::path& out);

}  // namespace relock::reproduction
