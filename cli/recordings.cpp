#include "cli/recordings.h"

#include <system_error>

namespace relock {

namespace fs = std::filesystem;

fs::path embedded_recordings(const fs::path& program) {
  const fs::path installed = program.parent_path().parent_path() / "share/relock/recordings";
  std::error_code ignored;
  return fs::is_directory(installed, ignored) ? installed : fs::path(RELOCK_RECORDINGS);
}

fs::path embedded_recordings() {
  std::error_code ignored;
  return embedded_recordings(fs::read_symlink("/proc/self/exe", ignored));
}

fs::path recording_path(const fs::path& given) {
  const fs::path embedded = embedded_recordings() / given;
  return !fs::exists(given) && fs::exists(embedded) ? embedded : given;
}

}  // namespace relock
