#pragma once

#include <filesystem>
#include <string>

#include "tests/fault.h"

namespace relock {

/// A folder of a test's own, gone with it.
class Scratch {
 public:
  Scratch();
  ~Scratch() { std::filesystem::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file, its folders included.
  void write(const std::string& name, const std::string& content) const;
  /// Writes pictures images/0.png, images/1.png, … of one grey level each: 10, 11, …
  void write_pictures(int count, int width = 64, int height = 48) const;

 private:
  std::filesystem::path path_;
};

}  // namespace relock
