#pragma once

#include <optional>

#include "core/image.h"

namespace relock {

/// A part of a picture, as a view of the same pixels.
struct Part {
  Image image;
  Vec2 offset;  ///< what to add to a point of the part to have it in the picture, px
};

/// The part in which a hint says to look: the hinted box and a margin around it, because a marker is found by
/// the white around it and thresholded against its neighbourhood. Without a hint, or with one that is no box,
/// it is the whole picture; a hint that lies outside of the picture leaves an empty part.
Part part_to_search(const Image& picture, const std::optional<Box>& where);

}  // namespace relock
