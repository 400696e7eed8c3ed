#include "cli/plugins/plugins.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <set>
#include <sstream>

#include "cli/catalogue.h"
#include "cli/plugins/shared_library.h"
#include "cli/plugins/table.h"
#include "cli/runs/child.h"
#include "core/error.h"
#include "sequences/open.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{10};  // for loading one

/// A file or a folder in which plug-ins may be.
struct Place {
  fs::path path;
  bool asked_for = false;
  bool must_exist = true;
};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::vector<Place> places(const std::vector<fs::path>& asked) {
  std::vector<Place> all;
  for (const fs::path& path : asked) all.push_back({path, true, true});
  std::istringstream list(variable("RELOCK_PLUGINS"));
  for (std::string path; std::getline(list, path, ':');)
    if (!path.empty()) all.push_back({path, false, true});
  const std::string data = variable("XDG_DATA_HOME"), home = variable("HOME");
  if (!data.empty()) {
    all.push_back({fs::path(data) / "relock/plugins", false, false});
  } else if (!home.empty()) {
    all.push_back({fs::path(home) / ".local/share/relock/plugins", false, false});
  }
  return all;
}

/// The shared libraries at a place, by name.
std::vector<fs::path> files_at(const Place& place) {
  std::error_code fault;
  if (!fs::is_directory(place.path, fault))
    return place.must_exist ? std::vector<fs::path>{place.path} : std::vector<fs::path>{};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(place.path, fault))
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty() && place.asked_for) throw Error("there is no shared library (*.so) in this folder");
  return files;
}

/// Loads it where a crash does no harm.
void try_in_child(const fs::path& file) {
  const auto end =
      run_in_child([&](const Tell&) { methods_of(load_plugin(file), {}); }, {.silence = kPatience}).end;
  if (end.kind == ChildEnd::Kind::finished) return;
  if (end.kind == ChildEnd::Kind::threw) throw Error(end.what);
  throw Error(fmt::format("it does not survive being loaded: it {}", end.what));
}

/// Adds all methods or none.
void add_all(Methods& known, const Methods& brought) {
  Methods both = known;
  const auto add = [&](const auto& entries, auto& registry) {
    for (const auto& entry : entries) {
      const auto names = method_names(both);
      if (std::find(names.begin(), names.end(), entry.name) != names.end())
        throw Error(fmt::format("another method is called \"{}\" already", entry.name));
      registry.add(entry);
    }
  };
  add(brought.detectors.entries(), both.detectors);
  add(brought.trackers.entries(), both.trackers);
  known = std::move(both);
}

void add_one(Methods& methods, const fs::path& file) {
  check_shared_library(file);
  try_in_child(file);
  const PluginFile origin{file.filename().string(), file_fingerprint(file)};
  add_all(methods, methods_of(load_plugin(file), origin));
}

}  // namespace

std::vector<LeftOut> add_plugins(Methods& methods, const std::vector<fs::path>& asked) {
  std::vector<LeftOut> left_out;
  std::set<fs::path> seen;  // one that is found twice is one
  for (const Place& place : places(asked)) {
    fs::path at_fault = place.path;
    const auto leave_out = [&](const Error& fault) {
      left_out.push_back({at_fault, fault.what(), place.asked_for});
    };
    try {
      for (const fs::path& file : files_at(place)) {
        at_fault = file;
        std::error_code ignored;
        if (!seen.insert(fs::weakly_canonical(file, ignored)).second) continue;
        try {
          add_one(methods, file);
        } catch (const Error& fault) {
          leave_out(fault);
        }
      }
    } catch (const Error& fault) {
      leave_out(fault);
    }
  }
  return left_out;
}

}  // namespace relock
