#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/bench/bench.h"

namespace relock::bench {

/// Some lines of the acceptance table that are measured together.
struct Row {
  std::string name;      ///< as --only takes it
  std::string sentence;  ///< what it measures
  std::function<std::vector<Measured>(Bench& bench)> measure;
};

/// In the order of the table. Those that count over all others come last.
const std::vector<Row>& rows();

}  // namespace relock::bench
