#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/json_text.h"
#include "cli/plot/plot.h"
#include "cli/program.h"
#include "cli/table.h"

// `relock reproduce`: the experiments of the paper, each run by what is built in, its figures printed beside the
// paper's.

namespace relock::reproduction {

struct Settings {
  std::filesystem::path out = "reproduction";
  bool quick = false;  ///< a first look: few conditions, marked QUICK in every figure
  int jobs = 1;
};

/// What came out of one experiment, to be printed and kept.
struct Finding {
  std::string id;                      ///< of the paper's figure or table, names its files: "figure-11"
  std::string title;                   ///< one line
  std::vector<Table> tables;           ///< the paper's figures beside ours
  std::vector<std::string> sentences;  ///< what departs from the paper, and where known, why
  std::vector<std::variant<Plot, LanePlot>> plots;  ///< files id.svg, id-2.svg, …
  std::vector<std::filesystem::path> pictures;      ///< that were written
  Json figures;                                     ///< the same, to be read by programs
};

/// One experiment: makes what is missing in `settings.out`, keeping what is there already, and reads all of it.
struct Experiment {
  std::string name;      ///< as --only takes it
  std::string sentence;  ///< what it does
  std::function<std::vector<Finding>(const Settings& settings, const Methods& methods)> run;
};

/// In the order of the paper.
const std::vector<Experiment>& experiments();

}  // namespace relock::reproduction
