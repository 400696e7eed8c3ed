#include "cli/interrupt.h"

#include <cstddef>

namespace relock {
namespace {

volatile std::sig_atomic_t interrupt = 0;

}  // namespace

InterruptNote::InterruptNote() {
  interrupt = 0;
  struct sigaction note {};
  note.sa_handler = [](int signal) { interrupt = signal; };
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &note, &before_[i]);
}

InterruptNote::~InterruptNote() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool InterruptNote::asked() const { return interrupt != 0; }

}  // namespace relock
