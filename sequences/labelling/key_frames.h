#pragma once

#include <optional>
#include <vector>

#include "core/recording.h"

namespace relock {

/// What is said of a target on a key frame.
enum class KeyState : std::uint8_t {
  placed,    ///< there, and here is its outline
  occluded,  ///< there, but more than half of it is hidden; the outline, if given, is where it is all the same
  absent,    ///< not in the picture
  unlabelled,  ///< nobody can tell
};
std::string_view to_string(KeyState state);
/// Throws Error when `text` is none.
KeyState parse_key_state(std::string_view text);

/// What a person says of one target on one frame, or a detector whose answer they took over.
struct KeyFrame {
  std::size_t frame = 0;
  KeyState state = KeyState::placed;
  std::optional<Outline> outline = {};  ///< always there when placed
  double sigma_px = 1.0;  ///< how exactly it was placed: one standard deviation, along each axis
  LabelSource source = {LabelSource::Kind::hand};
  friend bool operator==(const KeyFrame&, const KeyFrame&) = default;
};

/// All that was said of one target, by frame. A state lasts up to the next key frame: an absent one until the target
/// is seen again; but a placed one says where the target is on its own frame only.
struct KeyedTarget {
  TargetId id;
  std::vector<KeyFrame> keys;
  friend bool operator==(const KeyedTarget&, const KeyedTarget&) = default;
};

/// Puts a key frame in its place, instead of one that is there.
void put_key(KeyedTarget& target, KeyFrame key);
/// Takes it away, if it is there; whether it was.
bool take_key(KeyedTarget& target, std::size_t frame);

}  // namespace relock
