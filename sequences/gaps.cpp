#include "sequences/gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/random.h"
#include "sequences/timestamps.h"

namespace relock {
namespace {

constexpr double kPaperGapShare = 0.05;
constexpr std::int64_t kPaperGapSlots = 4;
// 1, 2 or 3 slots with probabilities 1 : q : q^2, where q makes the mean of all intervals, the paper's gaps
// included, 1.8 slots: (1 + 2q + 3q^2) / (1 + q + q^2) = (1.8 - 0.05 * 4) / 0.95.
constexpr double kPaper6sRatio = 0.61080;

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
  throw Error(
      fmt::format("the gap pattern \"{}\" {}; patterns are none, paper, paper-6s, gaps(n,p), "
                  "bernoulli(p), gilbert-elliott(p,r), periodic(n,k), trace(file) and fps(n)",
                  text, why));
}

struct Call {
  std::string_view name;
  std::vector<std::string_view> arguments;
};

Call split(std::string_view text) {
  const auto open = text.find('(');
  if (open == std::string_view::npos) return {text, {}};
  if (text.back() != ')') refuse(text, "has no closing parenthesis");
  Call call{text.substr(0, open), {}};
  std::string_view inside = text.substr(open + 1, text.size() - open - 2);
  if (call.name == "trace") return {call.name, {inside}};  // file names may have commas
  for (std::size_t comma; (comma = inside.find(',')) != std::string_view::npos;) {
    call.arguments.push_back(inside.substr(0, comma));
    inside.remove_prefix(comma + 1);
  }
  call.arguments.push_back(inside);
  return call;
}

double number(std::string_view text, std::string_view argument, double least, double most) {
  while (argument.starts_with(' ')) argument.remove_prefix(1);
  double value = 0;
  const auto [end, fault] = std::from_chars(argument.data(), argument.data() + argument.size(), value);
  if (fault != std::errc{} || end != argument.data() + argument.size() || !(value >= least && value <= most))
    refuse(text, fmt::format("has \"{}\" where a number from {} to {} belongs", argument, least, most));
  return value;
}

/// Whether each slot in turn is lost, the first one not asked for.
using SlotLoss = std::function<bool()>;

/// Slots lost between intervals of `next_interval()` slots.
SlotLoss between(std::function<std::int64_t()> next_interval) {
  return [left = std::int64_t{0}, next_interval = std::move(next_interval)]() mutable {
    if (left == 0) left = next_interval();
    return --left > 0;
  };
}

std::int64_t paper_6s_interval(Random& random) {
  if (random.chance(kPaperGapShare)) return kPaperGapSlots;
  const double q = kPaper6sRatio;
  const double drawn = random.uniform() * (1 + q + q * q);
  return drawn < 1 ? 1 : drawn < 1 + q ? 2 : 3;
}

Schedule at_rate(std::span<const Time> captured, double rate_hz) {
  Schedule schedule(captured.size());
  std::int64_t due = 0;
  for (std::size_t i = 0; i < captured.size(); ++i) {
    if (captured[i] - captured[0] < from_seconds(static_cast<double>(due) / rate_hz)) {
      schedule.drop(i);
    } else {
      while (from_seconds(static_cast<double>(due) / rate_hz) <= captured[i] - captured[0]) ++due;
    }
  }
  return schedule;
}

/// Frame by frame, slot by slot: a frame is dropped when its own slot is lost.
Schedule by_slots(std::span<const Time> captured, Duration period, SlotLoss next_is_lost) {
  Schedule schedule(captured.size());
  for (std::size_t i = 1; i < captured.size(); ++i) {
    bool lost = false;
    for (std::int64_t slot = slots(captured[i] - captured[i - 1], period); slot > 0; --slot)
      lost = next_is_lost();
    if (lost) schedule.drop(i);
  }
  return schedule;
}

std::vector<std::int64_t> trace_intervals(const std::string& file) {
  const auto captured = read_timestamps(std::filesystem::path(file)).captured;
  const Duration period = nominal_period(captured);
  std::vector<std::int64_t> intervals;
  for (std::size_t i = 1; i < captured.size(); ++i)
    intervals.push_back(slots(captured[i] - captured[i - 1], period));
  return intervals;
}

}  // namespace

GapPattern GapPattern::parse(std::string_view text) {
  const Call call = split(text);
  GapPattern pattern;
  pattern.text_ = text;
  const auto arguments = [&](std::size_t count) {
    if (call.arguments.size() != count) refuse(text, fmt::format("needs {} in parentheses", count));
  };
  if (call.name == "none" || call.name == "paper" || call.name == "paper-6s") {
    if (!call.arguments.empty()) refuse(text, "takes no numbers");
    pattern.kind_ = call.name == "none" ? Kind::none : call.name == "paper" ? Kind::paper : Kind::paper_6s;
  } else if (call.name == "gaps") {
    arguments(2);
    pattern.kind_ = Kind::gaps;
    pattern.a_ = number(text, call.arguments[0], 1, 1e9);
    pattern.b_ = number(text, call.arguments[1], 0, 1);
    if (pattern.a_ != std::floor(pattern.a_)) refuse(text, "needs a whole number of slots");
  } else if (call.name == "bernoulli") {
    arguments(1);
    pattern.kind_ = Kind::bernoulli;
    pattern.a_ = number(text, call.arguments[0], 0, 1);
  } else if (call.name == "gilbert-elliott") {
    arguments(2);
    pattern.kind_ = Kind::gilbert_elliott;
    pattern.a_ = number(text, call.arguments[0], 0, 1);
    pattern.b_ = number(text, call.arguments[1], 0, 1);
  } else if (call.name == "periodic") {
    arguments(2);
    pattern.kind_ = Kind::periodic;
    pattern.a_ = number(text, call.arguments[0], 1, 1e9);
    pattern.b_ = number(text, call.arguments[1], 0, pattern.a_);
    if (pattern.a_ != std::floor(pattern.a_) || pattern.b_ != std::floor(pattern.b_))
      refuse(text, "needs whole numbers");
  } else if (call.name == "trace") {
    arguments(1);
    pattern.kind_ = Kind::trace;
    pattern.intervals_ = trace_intervals(std::string(call.arguments[0]));
  } else if (call.name == "fps") {
    arguments(1);
    pattern.kind_ = Kind::fps;
    pattern.a_ = number(text, call.arguments[0], 1e-3, 1e6);
  } else {
    refuse(text, "is not known");
  }
  return pattern;
}

Schedule GapPattern::apply(std::span<const Time> captured, Duration period, std::uint64_t seed,
                           std::span<const FrameIndex> kept) const {
  Random random = Random(seed).fork(0x67617073);  // "gaps": apart from whatever else the seed serves
  Schedule schedule(captured.size());
  switch (kind_) {
    case Kind::none:
      break;
    case Kind::fps:
      schedule = at_rate(captured, a_);
      break;
    case Kind::paper:
      schedule = by_slots(captured, period,
                          between([&] { return random.chance(kPaperGapShare) ? kPaperGapSlots : 1; }));
      break;
    case Kind::gaps:
      schedule =
          by_slots(captured, period,
                   between([&, gap = static_cast<std::int64_t>(a_)] { return random.chance(b_) ? gap : 1; }));
      break;
    case Kind::paper_6s:
      schedule = by_slots(captured, period, between([&] { return paper_6s_interval(random); }));
      break;
    case Kind::trace: {
      std::size_t at = random.below(intervals_.size());
      schedule = by_slots(captured, period, between([&] { return intervals_[at++ % intervals_.size()]; }));
      break;
    }
    case Kind::bernoulli:
      schedule = by_slots(captured, period, [&] { return random.chance(a_); });
      break;
    case Kind::gilbert_elliott: {
      bool burst = false;
      schedule =
          by_slots(captured, period, [&] { return burst = burst ? !random.chance(b_) : random.chance(a_); });
      break;
    }
    case Kind::periodic: {
      const auto n = static_cast<std::int64_t>(a_), k = static_cast<std::int64_t>(b_);
      schedule = by_slots(captured, period, [n, k, slot = std::int64_t{0}]() mutable {
        slot = (slot + 1) % n;
        return slot >= n - k;
      });
      break;
    }
  }
  for (const FrameIndex frame : kept) schedule.keep(static_cast<std::size_t>(frame));
  return schedule;
}

}  // namespace relock
