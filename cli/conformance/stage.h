#pragma once

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/runs/child.h"
#include "core/error.h"

namespace relock {

/// What a check found: one clause that says where and what was expected.
class Broken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a check in its child process tells its parent: where it is, so that a crash or a hang has a place;
/// answers, which two processes are compared by; and how it ends.
class Stage {
 public:
  /// `second`: this is the second process of a check that takes two.
  explicit Stage(const Tell& tell, bool second = false) : tell_(tell), second_(second) {}

  bool is_second() const { return second_; }

  /// What is done now: "frame 3 (the target leaves the picture)".
  void at(std::string place);
  void answered(const std::string& answer) { tell_("s" + answer); }
  void passed(const std::string& note) { tell_("p" + note); }
  void not_asked(const std::string& why) { tell_("n" + why); }
  void broken(const std::string& reason) { tell_("b" + reason); }

  /// The check fails here, for this reason.
  [[noreturn]] void fail(const std::string& clause) const { throw Broken(place_ + ": " + clause); }

  /// Calls the method. Nothing may be thrown.
  template <class Call>
  auto call(const Call& call) const {
    try {
      return call();
    } catch (const Broken&) {
      throw;
    } catch (...) {
      fail(what_was_thrown() + ", where an answer was expected");
    }
  }

  /// Calls the method, which may throw Error. Whether it did; throwing anything else fails.
  template <class Call>
  bool refused(const Call& call) const {
    try {
      call();
      return false;
    } catch (const Broken&) {
      throw;
    } catch (const Error&) {
      return true;
    } catch (...) {
      fail(what_was_thrown() + ", where an Error or nothing was expected");
    }
  }

 private:
  /// Of the exception that is being handled.
  static std::string what_was_thrown();

  const Tell& tell_;
  bool second_;
  std::string place_;
};

/// What a Stage told, taken apart again.
struct StageReport {
  std::string place;                     ///< the last one
  std::vector<std::string> answers;      ///< with the places where they were given
  std::optional<std::string> note;       ///< of a check that passed
  std::optional<std::string> reason;     ///< of one that failed
  std::optional<std::string> not_asked;  ///< why it was not made
};
StageReport read_report(const std::vector<std::string>& messages);

}  // namespace relock
