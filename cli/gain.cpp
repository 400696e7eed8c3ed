// `relock gain`: what combinations gain over the tracker in them, with gaps and without.

#include <fmt/format.h>

#include "cli/arms.h"
#include "cli/gains.h"
#include "cli/readable.h"
#include "cli/verbs.h"

namespace relock {

int gain(const GainArguments& arguments) {
  const CostScore score = gain_score(arguments.score);
  return with_readable(find_results(arguments.folder), [&](const std::vector<StoredComparison>& results) {
    const auto experiments = gain_experiments(results, arguments.gate);
    if (arguments.json) {
      fmt::print("{}", gain_json(experiments));
      return;
    }
    for (const GainExperiment& e : experiments)
      fmt::print("{}{}", &e == &experiments.front() ? "" : "\n", gain_text(e, score));
    for (const std::string& sentence : without_a_pair(results)) fmt::print("  left out: {}\n", sentence);
  });
}

}  // namespace relock
