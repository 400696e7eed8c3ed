#include <algorithm>

#include "tests/eval/naive_parts.h"

// What was in force while the target was lost: metrics.md section 6.
namespace relock::naive {

using std::size_t;

Duration common(Time a, Time a_end, Time b, Time b_end) {
  return std::max(Duration(0), std::min(a_end, b_end) - std::max(a, b));
}

// An answer is in force until the next lost frame or the loss's end. Time before the first lost frame and
// under isolated Hits is left out.
LostTime lost_time_of(const Looks& looks, const TargetTimeline& timeline,
                      const std::vector<Interval>& visible) {
  LostTime sum;
  for (const Loss& loss : timeline.losses) {
    const auto first = static_cast<size_t>(loss.first_lost), end = static_cast<size_t>(loss.end_frame);
    for (size_t k = first; k < end; ++k) {
      if (!is_scored(looks[k].verdict) || looks[k].verdict == Verdict::Hit) continue;
      size_t next = k + 1;
      while (next < end && !is_scored(looks[next].verdict)) ++next;
      for (const Interval& each : visible) {
        if (timeline.states[each.frame] != State::Lost) continue;
        const Duration time = common(each.from, each.to, looks[k].captured, looks[next].captured);
        sum.told += time;
        if (looks[k].verdict != Verdict::Miss) sum.answered += time;
      }
    }
  }
  return sum;
}

}  // namespace relock::naive
