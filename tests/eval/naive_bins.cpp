#include "tests/eval/naive_parts.h"

// Recognition apart by what the frame came with: metrics.md section 6.
namespace relock::naive {

using std::size_t;

// Up to 5, 10, 20, 40, 80 px, longer, and not known.
size_t blur_bin(const TargetTruth& truth) {
  if (!truth.blur) return 6;
  const double length = distance(*truth.blur, {});
  if (length <= 5) return 0;
  if (length <= 10) return 1;
  if (length <= 20) return 2;
  if (length <= 40) return 3;
  if (length <= 80) return 4;
  return 5;
}

// Slots since the last frame that was not Dropped. Where all before were, the gap is at least as long as the
// recording so far; the first frame comes after one slot.
std::int64_t slots_before(const Looks& looks, size_t k, Duration period) {
  const auto last = last_before(looks, k, [](const Look& look) { return look.verdict != Verdict::Dropped; });
  const Duration interval = looks[k].captured - looks[last.value_or(0)].captured;
  // floor(interval / T + 1/2), in whole nanoseconds.
  const std::int64_t count = (2 * interval.count() + period.count()) / (2 * period.count());
  return count < 1 ? 1 : count;
}

// 1, 2, 3 to 4, 5 to 8 slots, and more.
size_t gap_bin(const Looks& looks, size_t k, Duration period) {
  const std::int64_t slots = slots_before(looks, k, period);
  if (slots <= 1) return 0;
  if (slots <= 2) return 1;
  if (slots <= 4) return 2;
  if (slots <= 8) return 3;
  return 4;
}

}  // namespace relock::naive
