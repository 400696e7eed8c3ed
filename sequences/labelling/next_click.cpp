#include "sequences/labelling/next_click.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relock {
namespace {

constexpr double kMiss_d = 0.25;  // so far off, a label calls a Hit a Stray

/// Frames between two key frames, or before the first or after the last.
struct Piece {
  std::size_t begin = 0, end = 0;  ///< its frames; `end` is not among them
  bool key_before = false, key_after = false;
};

std::vector<Piece> pieces_of(const KeyedTarget& target, std::size_t frames) {
  std::vector<Piece> pieces;
  std::size_t begin = 0;
  bool before = false;
  for (const KeyFrame& key : target.keys) {
    if (key.frame > begin) pieces.push_back({begin, key.frame, before, true});
    begin = key.frame + 1;
    before = true;
  }
  if (begin < frames) pieces.push_back({begin, frames, before, false});
  return pieces;
}

/// What is doubtful in a piece.
struct Doubt {
  double sum = 0;
  std::optional<Click> most;
  std::size_t clicks = 0;
};

class Looker {
 public:
  Looker(const FilledTarget& filled, std::span<const Time> captured, std::span<const double> likeness,
         const FillOptions& options)
      : filled_(filled), captured_(captured), likeness_(likeness), options_(options) {}

  Doubt look(const Piece& piece) const {
    switch (filled_.rests_on[piece.begin]) {
      case RestsOn::unknown:
        return look_unknown(piece);
      case RestsOn::curve:
        return look_curve(piece);
      default:
        return {};
    }
  }

 private:
  Doubt look_unknown(const Piece& piece) const {
    Doubt doubt;
    doubt.sum = static_cast<double>(piece.end - piece.begin);
    const double length_s = seconds(captured_[piece.end - 1] - captured_[piece.begin]);
    doubt.clicks =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length_s / options_.max_gap_s)));
    doubt.most = Click{reach(piece), Worth::unknown};
    return doubt;
  }

  /// The frame that joins the most of a piece to what is known: as far from its key frame as a curve may go.
  std::size_t reach(const Piece& piece) const {
    const Duration step = from_seconds(options_.max_gap_s);
    const auto begin = captured_.begin() + static_cast<std::ptrdiff_t>(piece.begin),
               end = captured_.begin() + static_cast<std::ptrdiff_t>(piece.end);
    if (piece.key_before) {
      const auto beyond = std::upper_bound(begin, end, captured_[piece.begin - 1] + step);
      const std::size_t last = static_cast<std::size_t>(beyond - captured_.begin());
      return std::max(piece.begin, last - 1);
    }
    if (!piece.key_after) return piece.begin;
    const auto first = std::lower_bound(begin, end, captured_[piece.end] - step);
    return std::min(piece.end - 1, static_cast<std::size_t>(first - captured_.begin()));
  }

  Doubt look_curve(const Piece& piece) const {
    Doubt doubt;
    double worst = 0, most = 0;
    bool disagrees = false;
    for (std::size_t frame = piece.begin; frame < piece.end; ++frame) {
      const TargetTruth& truth = filled_.truth[frame];
      if (!truth.outline) continue;  // out of the picture
      const double part = truth.sigma_px / size_of(*truth.outline);
      const bool unlike =
          truth.label == Label::visible && frame < likeness_.size() && likeness_[frame] < kLikeEnough;
      double of_frame = std::min(1.0, part / kMiss_d);
      if (unlike) of_frame = 1 + (kLikeEnough - likeness_[frame]);
      worst = std::max(worst, part);
      disagrees |= unlike;
      doubt.sum += std::min(1.0, of_frame);
      if (of_frame > most) {
        most = of_frame;
        doubt.most = Click{frame, unlike ? Worth::disagrees : Worth::uncertain};
      }
    }
    if (worst <= kSureEnough_d && !disagrees) return {};
    const double parts = std::pow(std::max(worst / kSureEnough_d, 1.0), 2.0 / 3);
    doubt.clicks =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(parts)) - 1, 1, piece.end - piece.begin);
    return doubt;
  }

  const FilledTarget& filled_;
  std::span<const Time> captured_;
  std::span<const double> likeness_;
  const FillOptions& options_;
};

}  // namespace

std::string_view to_string(Worth worth) {
  constexpr std::array<std::string_view, 4> names{"nothing yet", "unknown", "uncertain", "disagrees"};
  return names[static_cast<std::size_t>(worth)];
}

ClicksToGo clicks_to_go(const KeyedTarget& target, const FilledTarget& filled, std::span<const Time> captured,
                        std::span<const double> likeness, const FillOptions& options) {
  ClicksToGo result;
  double most = 0;
  const Looker looker(filled, captured, likeness, options);
  for (const Piece& piece : pieces_of(target, captured.size())) {
    const Doubt doubt = looker.look(piece);
    result.count += doubt.clicks;
    if (doubt.clicks == 0 || doubt.sum <= most) continue;
    most = doubt.sum;
    result.next = doubt.most;
  }
  if (target.keys.empty() && result.next) result.next = Click{0, Worth::nothing_yet};
  return result;
}

}  // namespace relock
