#include "cli/reproduce/folder.h"

#include <fmt/format.h>

#include "cli/files.h"
#include "core/error.h"

namespace relock::reproduction {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "reproduction-plan.json";

std::string plan_text(const Settings& settings) {
  return json_text({{"format", 1}, {"quick", settings.quick}});
}

/// Whether nothing is there but, maybe, the lock of a program that was killed before it wrote anything.
bool holds_nothing(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != ".lock") return false;
  return true;
}

void check_folder(const Settings& settings) {
  const fs::path& out = settings.out;
  if (!fs::exists(out)) return;
  if (!fs::is_directory(out))
    throw Error(fmt::format("{} is a file; a reproduction needs a folder", out.string()));
  if (!fs::exists(out / kMarker)) {
    if (holds_nothing(out)) return;
    throw Error(
        fmt::format("{} holds something else than a reproduction; choose another --out", out.string()));
  }
  if (read_file(out / kMarker) != plan_text(settings))
    throw Error(fmt::format("{} holds a {} reproduction, not a {} one; choose another --out or remove it",
                            out.string(), settings.quick ? "full" : "quick",
                            settings.quick ? "quick" : "full"));
}

}  // namespace

ResultsLock prepare_reproduction(const Settings& settings) {
  check_folder(settings);
  make_folder(settings.out);
  ResultsLock lock(settings.out);
  if (!fs::exists(settings.out / kMarker)) write_file(settings.out / kMarker, plan_text(settings));
  remove_left_behind(settings.out);
  return lock;
}

fs::path file_of(const Settings& settings, const std::string& id, std::size_t n, std::string_view ending) {
  return numbered(settings.out / fmt::format("{}{}{}", id, settings.quick ? "-QUICK" : "", ending), n);
}

}  // namespace relock::reproduction
