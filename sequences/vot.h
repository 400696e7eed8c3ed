#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "vot": a sequence of a VOT workspace, and VOT's layout before there were workspaces.
//   NAME/sequence                  key=value: channels.color=color/%08d.jpg, fps=30, length=…
//   NAME/color/00000001.jpg …      or ir, depth; before workspaces: NAME/00000001.jpg …, without `sequence`
//   NAME/groundtruth.txt           a region on each line; target "target"
//   NAME/groundtruth_ID.txt …      one for each target, called ID
//   NAME/occlusion.tag             0 or 1 on each line
//   NAME/timestamp.value           capture time in seconds on each line: an addition of relock's to VOT
// The channel read is channel.default's, else color, else the first named.
//
// Regions: a box x,y,w,h, a polygon of points, or a mask ("m…"). Of four points that turn one way all round
// it is a Quad (clockwise, first point first); of a mask, and of a polygon of another kind, the box around it.
// A NaN, and a line "0", say that the target is not there. A single line where there are more pictures is the
// start, the rest unlabelled; else there is a line for each picture.
//
// Coordinates are counted from the picture's corner: the toolkit (vot/region/raster.py) fills columns x to
// x + w - 1 of a box, so "0,0,w,h" is Box{-0.5, -0.5, w, h}; its conversion of boxes to polygons takes the
// same corners, so a polygon's points are moved by the same half pixel.
//
// Times: timestamps.csv, timestamp.value, a stated rate, fps, else 30 Hz (the toolkit's own default).
//
// occlusion.tag says that something hides the target, not how much. VOT scores these frames as any other, and
// their label and visible_fraction are the region's; but no run should start on them, so occluded_fraction is
// a tenth, the least that keeps a start away (metrics.md section 5). Other tags and values are not looked at.

bool recognises_vot(const std::filesystem::path& path);
FoundRecording find_vot(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
