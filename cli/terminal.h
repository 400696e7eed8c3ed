#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace relock {

/// What the place that is written to can show.
struct Terminal {
  bool is_terminal = false;  ///< a person is looking
  bool unicode = false;      ///< a terminal, and the locale is UTF-8
  bool colour = false;       ///< a terminal, and neither NO_COLOR nor TERM=dumb says otherwise
  int width = 120;           ///< columns; 120 in a pipe, or what COLUMNS says
};
/// `stream`: stdout or stderr.
Terminal terminal(std::FILE* stream);

/// Width in columns of a text without control characters: UTF-8 code points.
std::size_t columns_of(std::string_view text);
/// The text padded with spaces on the right to `columns`.
std::string padded(std::string_view text, std::size_t columns);
/// Likewise on the left.
std::string right_aligned(std::string_view text, std::size_t columns);

/// A line on stderr that changes while a long work goes on. It shows on a terminal only.
class ProgressLine {
 public:
  ProgressLine() : shown_(terminal(stderr).is_terminal) {}
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the text in place of the one before, some five times a second at most.
  void show(std::string_view text);

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  Clock::time_point drawn_{};
};

/// A progress line that tells how far a work of known length is and how long it will take.
class Progress {
 public:
  /// `what`: the work's name; `total`: its steps.
  Progress(std::string what, std::int64_t total) : what_(std::move(what)), total_(total) {}

  void done(std::int64_t steps);

 private:
  std::string what_;
  std::int64_t total_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  ProgressLine line_;
};

}  // namespace relock
