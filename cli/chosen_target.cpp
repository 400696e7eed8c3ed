#include "cli/chosen_target.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {

bool wanted(const Target& target, const std::optional<TargetId>& only) { return !only || target.id == *only; }

void check_target(const std::vector<StoredComparison>& all, const std::optional<TargetId>& only) {
  std::vector<std::string> ids;
  for (const StoredComparison& comparison : all) {
    for (const Target& target : comparison.recording.targets) {
      if (wanted(target, only)) return;
      ids.push_back(target.id);
    }
  }
  throw Error(
      fmt::format("there is no target \"{}\"{}", only.value_or(""), did_you_mean(only.value_or(""), ids)));
}

}  // namespace relock
