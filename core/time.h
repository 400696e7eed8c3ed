#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

namespace relock {

/// The clock of a recording: it starts at the recording's own epoch and has nothing to do with the wall.
struct RecordingClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
};

using Duration = std::chrono::nanoseconds;
/// When a picture was captured: integer nanoseconds from the recording's epoch. A frame index never stands in
/// for a time.
using Time = std::chrono::time_point<RecordingClock, Duration>;
/// Rank of a recorded frame, from 0.
using FrameIndex = std::int64_t;

constexpr Time time_ns(std::int64_t nanoseconds) { return Time{Duration{nanoseconds}}; }
constexpr std::int64_t ns(Time t) { return t.time_since_epoch().count(); }

/// Seconds as a double: for reports only.
constexpr double seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
constexpr double seconds(Time t) { return seconds(t.time_since_epoch()); }
/// The nearest whole nanosecond.
Duration from_seconds(double s);
/// The period of a rate in Hz, to the nearest nanosecond.
Duration period_of(double rate_hz);

/// Nominal period T of capture times that state no rate (metrics.md section 2): the median of the intervals
/// shorter than 1.5 times their 20th percentile, nearest rank, whole nanoseconds. A plain median fails on
/// bursty drops, a percentile on jitter. Throws Error with fewer than two times.
Duration nominal_period(std::span<const Time> captured);

/// Median of all intervals (nearest rank), the plain figure printed beside T when the two differ
/// by over 20 %.
Duration median_interval(std::span<const Time> captured);

/// The times as they pass when a recording is played backward: first + (last - time), in rising order.
std::vector<Time> reflected(std::span<const Time> captured);

/// Slots an interval spans: floor(dt / T + 1/2), at least 1. Two or more are a gap. Slots are counted and
/// seconds are not compared, because three slots at 30 Hz are 0.0999… or 0.1000… s.
std::int64_t slots(Duration interval, Duration period);

}  // namespace relock
