#include "tests/eval/naive_parts.h"

// A loss in hindsight: metrics.md section 4.
namespace relock::naive {

using std::size_t;

// Scored lost frames of each kind, isolated Hits aside, up to but without frame `end`.
std::array<int, kLossKinds> said_while_lost(const Looks& looks, const Loss& loss, size_t end) {
  std::array<int, kLossKinds> said{};
  for (auto k = static_cast<size_t>(loss.first_lost); k < end; ++k) {
    const Look& look = looks[k];
    if (look.verdict == Verdict::Miss) ++said[static_cast<size_t>(LossKind::Declared)];
    if (look.verdict == Verdict::WrongId) ++said[static_cast<size_t>(LossKind::WrongId)];
    if (look.verdict == Verdict::Stray) {
      const bool held_off_centre = loss.rule == LossRule::b && look.hold;
      ++said[static_cast<size_t>(held_off_centre ? LossKind::Drift : LossKind::Silent)];
    }
  }
  return said;
}

LossKind largest_share(const std::array<int, kLossKinds>& said) {
  LossKind best = LossKind::Silent;
  for (const LossKind kind : {LossKind::Silent, LossKind::WrongId, LossKind::Drift, LossKind::Declared})
    if (said[static_cast<size_t>(kind)] > said[static_cast<size_t>(best)]) best = kind;
  return best;
}

// Did the target come to the report? a: the last lost frame with a report, b: the first Hit.
bool is_chance(const Looks& looks, const Loss& loss, size_t first_hit) {
  const auto has_report = [](const Look& look) {
    return is_scored(look.verdict) && look.verdict != Verdict::Miss;
  };
  const auto last_report = last_before(looks, first_hit, has_report);
  if (!last_report || static_cast<FrameIndex>(*last_report) < loss.first_lost) return false;
  const Look &a = looks[*last_report], &b = looks[first_hit];
  if (a.verdict != Verdict::Stray || b.captured - a.captured > std::chrono::milliseconds(500)) return false;
  for (size_t k = *last_report; k < first_hit; ++k)
    if (looks[k].verdict == Verdict::Miss) return false;
  const double off = distance(a.reported, a.truth);
  if (off == 0) return false;  // no direction in which the target could have come
  const Vec2 u{(a.truth.x - a.reported.x) / off, (a.truth.y - a.reported.y) / off};
  const double s_r = times({b.reported.x - a.reported.x, b.reported.y - a.reported.y}, u);
  const double s_t = -times({b.truth.x - a.truth.x, b.truth.y - a.truth.y}, u);
  return distance(a.reported, b.reported) <= 0.1 * b.size && s_r < 0.25 * (s_r + s_t);
}

}  // namespace relock::naive
