#include "cli/recording_path.h"

namespace relock {

std::filesystem::path recording_path(const std::filesystem::path& given) {
  const auto embedded = std::filesystem::path(RELOCK_RECORDINGS) / given;
  return !std::filesystem::exists(given) && std::filesystem::exists(embedded) ? embedded : given;
}

}  // namespace relock
