#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/recording.h"

namespace relock {

/// How a method is started and what happens after a loss (metrics.md section 5).
enum class Protocol : std::uint8_t {
  once,   ///< from the true box on the first startable frame; recovery is the method's own business
  reset,  ///< likewise; once a loss is declared, started again on the next startable frame
  vot,  ///< likewise; once an answer does not overlap, started again five frames later (eval/replay/vot_rules.h)
  multistart,  ///< like once, from many frames, forward and backward (eval/replay/multistart.h)
  detect,      ///< no start: every frame on its own
};
std::string_view to_string(Protocol protocol);
/// Throws Error when `text` is none of them.
Protocol parse_protocol(std::string_view text);

/// Whether a method may be handed the target here: visible, fully in the picture, occluded by less than 10 %.
bool startable(const Recording& recording, std::size_t frame, std::size_t target);
/// For each target the first startable frame, none before `from`; nothing where there is none.
std::vector<std::optional<FrameIndex>> first_startable(const Recording& recording, FrameIndex from = 0);

}  // namespace relock
