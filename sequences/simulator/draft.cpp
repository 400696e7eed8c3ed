#include "sequences/simulator/draft.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "core/error.h"

namespace relock::simulator {

namespace fs = std::filesystem;

// A slash at its end would leave a path without a name.
Draft::Draft(const fs::path& place) : place_(place.has_filename() ? place : place.parent_path()) {
  if (fs::exists(place_))
    throw Error(fmt::format("{} is there already; choose another name or remove it", place_.string()));
  path_ = place_.parent_path() / fmt::format(".{}.tmp.{}", place_.filename().string(), getpid());
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Draft::~Draft() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

void Draft::put_in_place() {
  std::error_code fault;
  fs::rename(path_, place_, fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", place_.string(), fault.message()));
  path_.clear();
}

void make_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", folder.string(), fault.message()));
}

void write_bytes(const fs::path& file, std::span<const std::uint8_t> bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw Error(fmt::format("{} cannot be written; is the disk full?", file.string()));
}

}  // namespace relock::simulator
