#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/schedule.h"
#include "core/time.h"

// Real time (metrics.md section 7): frames arrive at their capture times whether the method is ready or not. The clock
// is virtual: nothing waits, and where latencies are not measured, the same frames are missed on every machine.

namespace relock {

/// Which frames wait for a method that is busy.
struct Waiting {
  /// How many may wait. One more that arrives takes the place of the oldest. One place: always the newest waits.
  std::size_t places = 1;
  friend bool operator==(const Waiting&, const Waiting&) = default;
};
/// "latest" (one place) or "queue(n)", n from 1 on.
std::string to_string(const Waiting& waiting);
/// Throws Error when `text` is neither.
Waiting parse_waiting(std::string_view text);

/// How long an answer takes, from when the method comes to a frame until its answer is there: a start on that frame
/// is part of it.
struct Latency {
  enum class Kind : std::uint8_t {
    measured,  ///< the wall time that it really takes: another one in every run
    constant,
    listed,  ///< frame by frame
  };
  Kind kind = Kind::measured;
  Duration constant{0};
  /// By rising frame. A frame that is not listed takes as long as the last listed one before it (none: the first).
  std::vector<std::pair<FrameIndex, Duration>> listed = {};
  std::string text = "measured";  ///< as it is printed and compared

  /// For the answer to `frame`, which took `wall`.
  Duration of(FrameIndex frame, Duration wall) const;
};
/// "constant(20ms)" (units s, ms, us; zero is none at all) or "measured". Throws Error otherwise.
Latency parse_latency(std::string_view text);

struct RealTime {
  Waiting waiting;
  Latency latency;
};

/// When the answer to a frame was there.
struct Answer {
  FrameIndex frame = 0;
  Time arrived;   ///< its capture time
  Time finished;  ///< never before `arrived`; answers finish in the order of their frames
  friend bool operator==(const Answer&, const Answer&) = default;
};

/// What a method that does one thing at a time comes to see.
///
///     VirtualClock clock(recording.captured, schedule, waiting);
///     for each recorded frame: if (clock.comes_to(frame)) clock.answered(frame, latency);
///
/// A frame that arrives in the very moment in which the method gets ready is there. When the recording is over, what
/// waits is still answered.
class VirtualClock {
 public:
  /// All of them must outlive the clock. Frames that are not delivered never arrive.
  VirtualClock(std::span<const Time> captured, const Schedule& schedule, const Waiting& waiting);

  /// Whether the method gets to look at the frame; else it is busy until something newer has taken its place.
  bool comes_to(FrameIndex frame) const { return next_ == frame; }
  /// The method came to `frame` and took `latency` over it.
  Answer answered(FrameIndex frame, Duration latency);

 private:
  /// Lets frames arrive up to and including `now`.
  void arrive(Time now);
  void come_to_the_next(Time ready);

  std::span<const Time> captured_;
  const Schedule& schedule_;
  Waiting waiting_;
  std::deque<FrameIndex> waiting_frames_;
  std::size_t to_arrive_ = 0;       // the first frame that has not arrived
  std::optional<FrameIndex> next_;  // that the method comes to
  Time begun_{};                    // when it does
};

}  // namespace relock
