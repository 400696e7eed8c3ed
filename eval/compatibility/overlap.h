#pragma once

#include "core/geometry.h"

namespace relock {

// The toolkits' overlaps. They differ: in where coordinates begin, in what the picture's border does, and in
// whether areas are continuous or counted in pixels.

/// A box as OTB and GOT-10k write it: 1-based pixels, "1,1,w,h" begins at the picture's very corner.
Box one_based(const Box& box);

/// An outline as VOT writes it: counted from the picture's corner. An ellipse becomes the box around it.
Outline from_corner(const Outline& outline);

/// GOT-10k toolkit, rect_iou with a bound: left and top edge of both boxes, as the files have them, are moved
/// into [0, width] x [0, height] WITHOUT changing the other side's distance, then sizes are cut at the
/// picture's right and lower border; continuous areas; the union is enlarged by the machine epsilon.
double got10k_overlap(const Box& answer, const Box& truth, Size picture);

/// OTB toolkit, calcRectInt: boxes of inclusive pixels, so that right edges lie at x + w - 1 and common widths
/// are one more than differences. The ones cancel: it is the continuous overlap, not bounded by the picture. (Cut
/// at 1: the toolkit's own rounding takes equal boxes to a hair above it, which counts as > 1.)
double otb_overlap(const Box& answer, const Box& truth);

/// VOT toolkit (vot/region/raster.py): single-precision coordinates, rounded to the nearest whole pixel (ties
/// to even), filled as masks inside the picture, and counted. A box fills columns x to x + w - 1; a polygon
/// fills, in each row it touches, from the first to the last crossing of its edges, both included, so it is
/// a pixel larger each way than the box of the same corners. Two regions that are less than two pixels wide
/// or high together overlap by 1; regions whose common bounds meet the picture in less, by 0.
double vot_overlap(const Outline& answer, const Outline& truth, Size picture);

}  // namespace relock
