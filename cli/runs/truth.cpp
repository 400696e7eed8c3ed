#include "cli/runs/truth.h"

#include <fmt/format.h>

#include "cli/files.h"
#include "core/error.h"
#include "sequences/open.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = "recording";
constexpr const char* kFingerprint = "fingerprint";
constexpr const char* kTruthFiles[] = {"recording.toml", "timestamps.csv", "labels.csv"};

/// One line for each file of the truth: what it was when runs were made.
void store_checksums(const fs::path& truth) {
  std::string text;
  for (const char* file : kTruthFiles) text += fmt::format("{} {}\n", file, file_fingerprint(truth / file));
  write_file(truth / "checksums", text);
}

/// Throws Error when a file of the truth is not what it was: scores would be of something that no method saw.
void check_checksums(const fs::path& truth) {
  if (!fs::exists(truth / "checksums")) return;
  const std::string stored = read_file(truth / "checksums");
  for (const char* file : kTruthFiles)
    if (stored.find(fmt::format("{} {}\n", file, file_fingerprint(truth / file))) == std::string::npos)
      throw Error(
          fmt::format("{} was changed after the runs beside it were made; change it where the recording is "
                      "and run again",
                      (truth / file).string()));
}

fs::path place_of(const fs::path& out, const Recording& recording) {
  return out / slug(recording.name) / kFolder;
}

}  // namespace

void check_truth(const fs::path& out, const Recording& recording, const std::string& fingerprint) {
  const fs::path place = place_of(out, recording);
  if (!fs::exists(place) || read_file(place / kFingerprint) == fingerprint + "\n") return;
  throw Error(
      fmt::format("{} was made from other pictures, times or labels than {} has now; choose another "
                  "--out or remove it",
                  place.parent_path().string(), recording.name));
}

void store_truth(const fs::path& out, const Recording& recording, const std::string& fingerprint) {
  check_truth(out, recording, fingerprint);
  const fs::path place = place_of(out, recording);
  if (fs::exists(place)) return;
  const fs::path draft = temporary_name(place);
  make_folder(draft);
  write_truth(draft, recording);
  store_checksums(draft);
  write_file(draft / kFingerprint, fingerprint + "\n");
  put_in_place(draft, place);
}

StoredTruth read_stored_truth(const fs::path& recording_folder) {
  StoredTruth truth;
  truth.folder = recording_folder / kFolder;
  if (!fs::exists(truth.folder))
    throw Error(fmt::format("{} is missing: runs cannot be scored without the truth beside them",
                            truth.folder.string()));
  truth.recording = read_truth(truth.folder);
  check_checksums(truth.folder);
  if (const fs::path file = truth.folder / kFingerprint; fs::exists(file)) {
    truth.fingerprint = read_file(file);
    if (truth.fingerprint->ends_with('\n')) truth.fingerprint->pop_back();
  }
  return truth;
}

}  // namespace relock
