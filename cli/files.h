#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace relock {

/// The whole of a file; throws Error when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes a text file whole or not at all; throws Error when it cannot be written.
void write_file(const std::filesystem::path& path, const std::string& content);

/// Of several files that one was asked for, the n-th from 0: "out.png", "out-2.png", "out-3.png", …
std::filesystem::path numbered(const std::filesystem::path& first, std::size_t n);

/// Where a draft of `path` is written before it is renamed.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// A name that any file system takes: whatever is not a letter, a digit, '.', '_' or '-' becomes '-'.
std::string slug(std::string_view text);

/// Makes a folder, and those that it is in; throws Error when it cannot be made.
void make_folder(const std::filesystem::path& folder);

/// Puts a finished folder in its place. An older one is moved away first, whole, and then removed: whoever is
/// killed in between leaves nothing that is half there.
void put_in_place(const std::filesystem::path& finished, const std::filesystem::path& place);

}  // namespace relock
