#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace relock {

/// The whole of a file; throws Error when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes a text file whole or not at all; throws Error when it cannot be written.
void write_file(const std::filesystem::path& path, const std::string& content);

/// Of several files that one was asked for, the n-th from 0: "out.png", "out-2.png", "out-3.png", …
std::filesystem::path numbered(const std::filesystem::path& first, std::size_t n);

/// Where a draft of `path` is written before it is renamed.
std::filesystem::path temporary_name(const std::filesystem::path& path);

}  // namespace relock
