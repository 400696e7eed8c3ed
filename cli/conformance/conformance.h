#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/method_spec.h"
#include "cli/program.h"

// Whether a method keeps what core/tracker.h and core/detector.h promise. docs/checking-a-method.md says what
// each check asks and why.

namespace relock {

struct ConformanceOptions {
  std::optional<std::string> only;                              ///< name of the one check to make; else all
  int frames = 10'000;                                          ///< of the check `memory`
  std::chrono::nanoseconds budget = std::chrono::seconds(60);   ///< most time that `memory` takes
  std::chrono::nanoseconds silence = std::chrono::seconds(30);  ///< longest time that a call may take
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;          ///< most that a method may allocate
};

struct CheckResult {
  enum class Kind : std::uint8_t {
    passed,
    failed,
    not_asked,
    known,  ///< failed, as its entry says that it does
  };
  std::string check;
  Kind kind = Kind::passed;
  std::string reason;  ///< one clause; of a check that passed, a note, often empty
};
std::string_view to_string(CheckResult::Kind kind);

struct Conformance {
  std::string method;  ///< as it would be typed
  std::string kind;    ///< "tracker" or "detector"
  std::vector<CheckResult> checks;

  std::size_t count(CheckResult::Kind kind) const;
};

using OnCheck = std::function<void(const Conformance& so_far)>;

/// Makes the checks, each in a process of its own, so that a method that crashes, hangs or eats memory fails
/// that check and the others go on. `on_check` is called after each. Throws Error for a method, an option of
/// it or a check that there is not.
Conformance check_method(
    const Methods& methods, const MethodSpec& spec, const ConformanceOptions& options,
    const OnCheck& on_check = [](const Conformance&) {});

}  // namespace relock
