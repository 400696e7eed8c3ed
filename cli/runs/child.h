#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Work that must not take the program down with it: it is done in a forked process. The child has everything
// that its parent had in memory, so that nothing is loaded twice, and tells its parent what it finds.

namespace relock {

/// What a child process may do.
struct ChildLimits {
  std::optional<std::chrono::nanoseconds> silence = {};  ///< longest time without a message; else for ever
  std::optional<std::uint64_t> memory_bytes = {};        ///< what it may allocate; else what there is
};

/// What ChildEnd says of a child that had no memory left.
inline constexpr std::string_view kRanOutOfMemory = "ran out of memory";

/// How a child process ended.
struct ChildEnd {
  enum class Kind : std::uint8_t {
    finished,  ///< its work returned
    threw,     ///< its work threw an exception
    crashed,   ///< a signal killed it, or it left the program by itself
    hung,      ///< it was silent for longer than its limit, and was killed
  };
  Kind kind = Kind::finished;
  std::string what = {};  ///< what was thrown, or "was killed by signal 11 (SIGSEGV)"; empty when finished
  std::string tail = {};  ///< the last of what it wrote to stdout and stderr
};

/// Sends a text from the child to its parent, whole and in order.
using Tell = std::function<void(std::string_view message)>;

/// One child process. It dies with this object, and with the program.
class Child {
 public:
  /// Forks; `work` runs in the child. Its stdout and stderr are kept back, its stdin is empty. Throws Error
  /// when the system gives no process.
  Child(const std::function<void(const Tell&)>& work, const ChildLimits& limits = {});
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The messages that came since the last call. Does not wait.
  std::vector<std::string> take();
  /// How it ended; nothing while it runs or messages are still to be taken. Kills it when it is silent for
  /// too long.
  std::optional<ChildEnd> end();
  /// Ends it at once.
  void kill();

  /// Waits until one of the children has something to tell or has ended, at most `at_most`.
  static void wait_for_any(std::span<const Child* const> children, std::chrono::milliseconds at_most);

 private:
  [[noreturn]] void be_the_child(const std::function<void(const Tell&)>& work, int messages, int output);
  void read_all();
  void parse();
  ChildEnd end_of(int status) const;

  ChildLimits limits_;
  pid_t pid_ = -1;
  int messages_ = -1, output_ = -1;  // read ends
  std::string bytes_, tail_;
  std::vector<std::string> told_;
  std::optional<ChildEnd> last_word_;  // the child's own: finished, or what was thrown
  std::optional<ChildEnd> end_;
  std::chrono::steady_clock::time_point heard_ = std::chrono::steady_clock::now();
};

/// A child that was waited for.
struct ChildResult {
  ChildEnd end;
  std::vector<std::string> messages;  ///< in the order in which they were told
};
ChildResult run_in_child(const std::function<void(const Tell&)>& work, const ChildLimits& limits = {});

}  // namespace relock
