#pragma once

#include <filesystem>
#include <string>

namespace relock {

/// The whole of a file; throws Error when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes a text file whole or not at all; throws Error when it cannot be written.
void write_file(const std::filesystem::path& path, const std::string& content);

/// Where a draft of `path` is written before it is renamed.
std::filesystem::path temporary_name(const std::filesystem::path& path);

}  // namespace relock
