#include "sequences/labelling/key_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"

namespace relock {
namespace {

constexpr std::array<std::string_view, 4> kStates{"placed", "occluded", "absent", "unlabelled"};

auto place_of(KeyedTarget& target, std::size_t frame) {
  return std::lower_bound(target.keys.begin(), target.keys.end(), frame,
                          [](const KeyFrame& key, std::size_t at) { return key.frame < at; });
}

}  // namespace

std::string_view to_string(KeyState state) { return kStates[static_cast<std::size_t>(state)]; }

KeyState parse_key_state(std::string_view text) {
  for (std::size_t i = 0; i < kStates.size(); ++i)
    if (kStates[i] == text) return static_cast<KeyState>(i);
  throw Error(fmt::format("\"{}\" is none of {}", text, fmt::join(kStates, ", ")));
}

void put_key(KeyedTarget& target, KeyFrame key) {
  const auto at = place_of(target, key.frame);
  if (at != target.keys.end() && at->frame == key.frame) {
    *at = std::move(key);
  } else {
    target.keys.insert(at, std::move(key));
  }
}

bool take_key(KeyedTarget& target, std::size_t frame) {
  const auto at = place_of(target, frame);
  if (at == target.keys.end() || at->frame != frame) return false;
  target.keys.erase(at);
  return true;
}

}  // namespace relock
