#include "eval/replay/real_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace relock {
namespace {

constexpr std::size_t kMostPlaces = 1'000'000;
constexpr double kLongestLatency_s = 3600;

/// "20" of "constant(20ms)" for `name` "constant" and `end` "ms)"; nothing when it is not of that form.
std::optional<double> number_within(std::string_view text, std::string_view name, std::string_view end) {
  if (!text.starts_with(name) || !text.ends_with(end) || text.size() <= name.size() + end.size()) return {};
  text = text.substr(name.size(), text.size() - name.size() - end.size());
  double value = 0;
  const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace

std::string to_string(const Waiting& waiting) {
  return waiting.places == 1 ? "latest" : fmt::format("queue({})", waiting.places);
}

Waiting parse_waiting(std::string_view text) {
  if (text == "latest") return {};
  const auto places = number_within(text, "queue(", ")");
  if (places && *places == std::floor(*places) && *places >= 1 && *places <= kMostPlaces)
    return {static_cast<std::size_t>(*places)};
  throw Error(
      fmt::format("real time \"{}\" is none; there are latest and queue(n), n a whole number from 1 to {}",
                  text, kMostPlaces));
}

Duration Latency::of(FrameIndex frame, Duration wall) const {
  if (kind == Kind::measured) return wall;
  if (kind == Kind::constant) return constant;
  const auto after = std::upper_bound(listed.begin(), listed.end(), frame,
                                      [](FrameIndex f, const auto& entry) { return f < entry.first; });
  return after == listed.begin() ? listed.front().second : std::prev(after)->second;
}

Latency parse_latency(std::string_view text) {
  if (text == "measured") return {};
  constexpr std::pair<std::string_view, double> kUnits[] = {{"ms)", 1e-3}, {"us)", 1e-6}, {"s)", 1}};
  for (const auto& [unit, in_s] : kUnits) {
    const auto number = number_within(text, "constant(", unit);
    if (!number || *number < 0 || *number * in_s > kLongestLatency_s) continue;
    Latency latency{Latency::Kind::constant, from_seconds(*number * in_s)};
    latency.text = fmt::format("constant({}ms)", 1e3 * seconds(latency.constant));
    return latency;
  }
  throw Error(fmt::format(
      "the latency \"{}\" is none; there are measured, constant(20ms) (or s, us; up to an hour) and a "
      "file with columns frame and wall_ms",
      text));
}

VirtualClock::VirtualClock(std::span<const Time> captured, const Schedule& schedule, const Waiting& waiting)
    : captured_(captured), schedule_(schedule), waiting_(waiting) {
  if (!captured.empty()) come_to_the_next(captured.front());
}

Answer VirtualClock::answered(FrameIndex frame, Duration latency) {
  if (!comes_to(frame)) throw Error(fmt::format("the method never came to frame {}", frame));
  const Answer answer{frame, captured_[static_cast<std::size_t>(frame)], begun_ + latency};
  come_to_the_next(answer.finished);
  return answer;
}

void VirtualClock::arrive(Time now) {
  for (; to_arrive_ < captured_.size() && captured_[to_arrive_] <= now; ++to_arrive_) {
    if (!schedule_.delivered(to_arrive_)) continue;
    waiting_frames_.push_back(static_cast<FrameIndex>(to_arrive_));
    if (waiting_frames_.size() > waiting_.places) waiting_frames_.pop_front();
  }
}

void VirtualClock::come_to_the_next(Time ready) {
  arrive(ready);
  for (begun_ = ready; waiting_frames_.empty() && to_arrive_ < captured_.size();) {
    begun_ = captured_[to_arrive_];
    arrive(begun_);
  }
  next_.reset();
  if (waiting_frames_.empty()) return;
  next_ = waiting_frames_.front();
  waiting_frames_.pop_front();
}

}  // namespace relock
