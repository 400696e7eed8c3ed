#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.h"
#include "detectors/marker_cells.h"

// A small made-up world: a target before a textured wall. All of it is drawn from core/random.h and without a
// library, so that it is the same everywhere.

namespace relock {

/// A picture that owns its pixels, row by row without gaps.
struct Picture {
  Size size;
  PixelFormat format = PixelFormat::bgr8;
  std::vector<std::uint8_t> bytes;

  std::size_t row_bytes() const { return static_cast<std::size_t>(size.width * channels(format)); }
  Image view() const { return Image(bytes.data(), size, format, row_bytes()); }
};

using Colour = std::array<double, 3>;  ///< blue, green and red, 0 to 255
/// What a target looks like at a point of its box: (0, 0) is the top left corner, (1, 1) the bottom right one.
using Look = std::function<Colour(double u, double v)>;

/// Smooth, strongly contrasted blobs of colour.
Look textured(std::uint64_t seed);
/// A printed marker with its white margin.
Look printed(const MarkerCells& print);

/// The same wall, with the target wherever it is asked for.
class Scene {
 public:
  Scene(Size size, Look target, std::uint64_t seed);

  Size size() const { return wall_.size; }
  /// In colour. Every pixel of the target's edge is an average over its area, so that parts of a pixel count.
  Picture with_target(const Box& box) const;
  const Picture& wall() const { return wall_; }

 private:
  Picture wall_;
  Look target_;
};

Picture flat(Size size, std::uint8_t grey);
Picture noise(Size size, std::uint64_t seed);
/// The mean of the three colours; a grey picture as it is.
Picture grey_of(const Picture& picture);

/// A picture of a film, and what is special about it.
struct Shot {
  Picture picture;
  std::string what = {};
  FrameIndex index = 0;
  Time captured = {};

  Frame frame() const { return frame(picture.view()); }
  /// The same frame with its pixels elsewhere.
  Frame frame(const Image& image) const { return {index, captured, image}; }
};

/// What a method is shown in a check.
struct Film {
  Box start;  ///< the target's box in the first picture
  std::vector<Shot> shots;

  /// One frame later at 30 Hz; `lost` frames were dropped before it, `pause` went by besides.
  void add(Picture picture, std::string what = {}, FrameIndex lost = 0, Duration pause = {});
};

/// The target moves plainly for `frames` frames, `velocity` px a frame, from `start`.
Film moving(const Scene& scene, const Box& start, Vec2 velocity, int frames);
/// Out of the picture to the left, away for four frames, and back.
Film leaving(const Scene& scene, const Box& start);
/// Smaller and smaller, until nothing is left of it.
Film shrinking(const Scene& scene, const Box& start);
/// From one frame to the next only the wall is there; later the target is back.
Film vanishing(const Scene& scene, const Box& start);
/// Black, white and noisy frames between good ones.
Film blank(const Scene& scene, const Box& start);
/// Grey and colour by turns; the first picture is grey if `first` says so.
Film grey_between(const Scene& scene, const Box& start, PixelFormat first);
/// Frames are lost, once for 5 s.
Film gappy(const Scene& scene, const Box& start);

}  // namespace relock
