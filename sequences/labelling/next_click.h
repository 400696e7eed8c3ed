#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sequences/labelling/fill.h"

namespace relock {

/// Why a frame is worth a click.
enum class Worth : std::uint8_t {
  nothing_yet,  ///< the target has no key frame at all
  unknown,      ///< no key frame tells where it is
  uncertain,    ///< the curve's sigma is more than a twentieth of the target's size
  disagrees,    ///< the picture under the curve is not like that of the last key frame
};
std::string_view to_string(Worth worth);

struct Click {
  std::size_t frame = 0;
  Worth worth = Worth::unknown;
};

/// Where one more key frame helps most, and how many are still worth it.
struct ClicksToGo {
  std::optional<Click> next;  ///< nothing: none is
  std::size_t count =
      0;  ///< estimated: a curve's sigma falls with the 3/2th power of the distance of key frames
};

/// A curve is sure enough up to this part of the target's size D, a fifth of what makes a Hit.
constexpr double kSureEnough_d = 0.05;
/// Pictures correlate at least so far where they show the same.
constexpr double kLikeEnough = 0.5;

/// The frames between two key frames are one piece; a click settles most of the doubt of the piece it is in. The next
/// click is on the most doubtful frame of the piece that holds the most doubt: on each frame 1 where nobody knows where
/// the target is or the picture disagrees, else sigma_px as part of a quarter of D.
/// `likeness`: of each frame the correlation of the picture under the label with that under the last key frame's
/// (cli/labelling/likeness.h); empty or NaN where it is not known.
ClicksToGo clicks_to_go(const KeyedTarget& target, const FilledTarget& filled, std::span<const Time> captured,
                        std::span<const double> likeness, const FillOptions& options);

}  // namespace relock
