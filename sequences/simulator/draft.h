#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace relock::simulator {

/// A file or folder that is written under a temporary name beside its place, and is there whole or not at all.
class Draft {
 public:
  /// Throws Error when something is at `place` already: a recording is never written over.
  explicit Draft(const std::filesystem::path& place);
  /// Removes what was not put in its place.
  ~Draft();
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  /// Where to write. Nothing is there at first.
  const std::filesystem::path& path() const { return path_; }
  /// Throws Error when the finished thing cannot be moved to its place.
  void put_in_place();

 private:
  std::filesystem::path place_, path_;
};

/// Makes a folder, and those above it; throws Error when that cannot be.
void make_folder(const std::filesystem::path& folder);
/// Throws Error when the file cannot be written to its end: a full disk is told of, never a file cut short.
void write_bytes(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

}  // namespace relock::simulator
