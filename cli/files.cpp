#include "cli/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/error.h"

namespace relock {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(fmt::format("{} cannot be read", path.string()));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

fs::path numbered(const fs::path& first, std::size_t n) {
  if (n == 0) return first;
  return first.parent_path() /
         fmt::format("{}-{}{}", first.stem().string(), n + 1, first.extension().string());
}

fs::path temporary_name(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.tmp.{}", path.filename().string(), getpid());
}

void write_file(const fs::path& path, const std::string& content) {
  const fs::path draft = temporary_name(path);
  std::ofstream out(draft, std::ios::binary);
  out << content;
  out.close();
  std::error_code fault;
  if (out) fs::rename(draft, path, fault);
  if (!out || fault) {
    std::error_code ignored;
    fs::remove(draft, ignored);
    throw Error(
        fmt::format("{} cannot be written; is the disk full, or the folder another user's?", path.string()));
  }
}

std::string slug(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-';
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() || name.front() == '.' ? "_" + name : name;
}

void make_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", folder.string(), fault.message()));
}

void put_in_place(const fs::path& finished, const fs::path& place) {
  const fs::path old = temporary_name(place.string() + ".old");
  if (fs::exists(place)) fs::rename(place, old);
  fs::rename(finished, place);
  fs::remove_all(old);
}

}  // namespace relock
