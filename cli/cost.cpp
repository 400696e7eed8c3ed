// `relock cost`: what the gaps cost each method, from runs made with `relock run --paired`.

#include <fmt/format.h>

#include "cli/paired.h"
#include "cli/readable.h"
#include "cli/verbs.h"

namespace relock {

int cost(const ResultsArguments& arguments) {
  return with_readable(find_results(arguments.folder), [&](const std::vector<StoredComparison>& results) {
    if (arguments.json) {
      fmt::print("{}", cost_json(gap_experiments(results, arguments.gate)));
    } else {
      print_cost_of_gaps(results, arguments.gate);
    }
  });
}

}  // namespace relock
