// `relock cost`: what the gaps cost each method, from runs made with `relock run --paired`.

#include <fmt/format.h>

#include "cli/paired.h"
#include "cli/verbs.h"

namespace relock {

int cost(const CostArguments& arguments) {
  auto comparisons = read_results(arguments.folder);
  if (arguments.json) {
    fmt::print("{}", cost_json(gap_experiments(std::move(comparisons), arguments.gate)));
  } else {
    print_cost_of_gaps(std::move(comparisons), arguments.gate);
  }
  return 0;
}

}  // namespace relock
