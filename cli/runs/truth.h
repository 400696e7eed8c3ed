#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/recording.h"

namespace relock {

// What is true of a recording, kept beside its runs: OUT/RECORDING/recording/ (cli/runs/folder.h). With it, what the
// recording's files were, and what its own were when they were written.

/// Throws Error when OUT/RECORDING was made from another recording or other labels.
void check_truth(const std::filesystem::path& out, const Recording& recording,
                 const std::string& fingerprint);
/// Writes OUT/RECORDING/recording unless the same is there. Throws Error like `check_truth`.
void store_truth(const std::filesystem::path& out, const Recording& recording,
                 const std::string& fingerprint);

/// The truth of a results folder.
struct StoredTruth {
  std::filesystem::path folder;
  Recording recording;  ///< as recorded
  std::optional<std::string>
      fingerprint;  ///< of the pictures, times and labels that it was made from, if it was kept
};
/// Of OUT/RECORDING. Throws Error when it is not there, cannot be read, or was changed after it was written.
StoredTruth read_stored_truth(const std::filesystem::path& recording_folder);

}  // namespace relock
