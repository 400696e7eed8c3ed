#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/frame_source.h"

namespace relock {

/// Whether the program ffmpeg is there; the tests of videos make their files with it.
bool has_ffmpeg();

/// Runs ffmpeg with these arguments; a test that cannot is a test that fails.
void ffmpeg(const std::string& arguments);

/// As an input of ffmpeg: `slots` pictures at 30 Hz, 64 px wide or more, whose black and white bars tell their
/// slot, so that a frame shows itself when it was captured, whatever frames are missing before it.
std::string barred(int slots, const std::string& size = "64x48");
/// As an option of ffmpeg: 30 Hz with two gaps, of 45 and of 15 slots, and every seventh slot missing besides,
/// the first included.
extern const std::string kGaps;
/// The slots of 0…slots-1 that kGaps leaves.
std::vector<int> slots_left(int slots);

/// The slot that a barred picture tells.
int slot_shown(const Image& picture);
/// The slots that the times tell, at 30 Hz, if the first is in slot `first`: a container may shift them all.
std::vector<int> slots_of_times(std::span<const Time> captured, int first);
/// The slots that all pictures tell.
std::vector<int> slots_of_pictures(FrameSource& source);

}  // namespace relock
