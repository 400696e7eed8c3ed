#pragma once

#include <array>
#include <csignal>

namespace relock {

/// As long as it lives, Ctrl-C, SIGTERM and SIGHUP end nothing by themselves: what is at work asks `asked`, tidies up
/// and ends.
class InterruptNote {
 public:
  InterruptNote();
  ~InterruptNote();
  InterruptNote(const InterruptNote&) = delete;
  InterruptNote& operator=(const InterruptNote&) = delete;

  /// Whether one has come since.
  bool asked() const;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
};

/// Exit status of a program that an interrupt ended.
constexpr int kInterrupted = 130;

}  // namespace relock
