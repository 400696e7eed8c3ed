#pragma once

#include <filesystem>
#include <string>

#include "cli/runs/plan.h"
#include "cli/runs/truth.h"
#include "sequences/open.h"

// Results hold truth and answers, and no pictures. Where the recording was is kept beside the truth, so that its
// pictures are found again: OUT/RECORDING/recording/source.toml. Paths in it are relative to that folder, so that
// results and recordings can be moved together.

namespace relock {

/// Keeps where the recording was and how it was opened. Results without it lose nothing but pictures.
void store_source(const std::filesystem::path& out, const std::string& recording,
                  const PlannedSequence& source);

/// The recording that a truth was made from: where it was, else the one of its name that relock comes with. Throws
/// Error when it is not there any more, or is not what the runs were made on.
Sequence open_source(const StoredTruth& truth);
/// Likewise, from `path`. Throws Error when it is not what the runs were made on.
Sequence open_source(const StoredTruth& truth, const std::filesystem::path& path);

}  // namespace relock
