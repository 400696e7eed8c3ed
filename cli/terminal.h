#pragma once

#include <chrono>
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

/// A line on stderr that tells how far a long work is and how long it will take. It shows on a terminal only.
class Progress {
 public:
  /// `what`: the work's name; `total`: its steps.
  Progress(std::string what, std::int64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void done(std::int64_t steps);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  std::int64_t total_;
  bool shown_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace relock
