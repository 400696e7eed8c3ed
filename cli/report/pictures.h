#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/comparison.h"
#include "cli/json_text.h"

namespace relock::reports {

struct PictureOptions {
  std::size_t budget_bytes = 4'000'000;               ///< of all pictures, as they stand in the page
  std::vector<std::filesystem::path> sequences = {};  ///< recordings that are not where they were
};

/// Small pictures of the frames about events: of every loss the frame that held last, the first that did not, and the
/// one that ended it; of every method its start and its worst frame. When they are more than the budget allows, the first
/// losses of every method come first, and pictures are smaller, down to 240 px.
struct Pictures {
  Json recordings = Json::array();  ///< [{"name", "pictures": [data: URL, …]}, …]
  /// Of each comparison its recording, and the frames of which there is a picture: what is true there and what was said.
  std::vector<Json> of_comparisons;
  std::size_t wanted = 0, kept = 0;
  std::vector<std::string> missing;  ///< why recordings have none, a sentence each
};
Pictures pictures_of(const std::vector<ScoredComparison>& all, const PictureOptions& options);

}  // namespace relock::reports
