#include "sequences/euroc.h"

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"
#include "sequences/benchmark.h"
#include "sequences/image_folder.h"
#include "sequences/timestamps.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

bool is_camera(const fs::path& folder) {
  return fs::is_regular_file(folder / "data.csv") && fs::is_directory(folder / "data");
}

/// The camera's folder that a path means; empty if it means none.
fs::path camera_of(const fs::path& path) {
  for (const fs::path& folder : {path / "mav0" / "cam0", path / "cam0", path})
    if (is_camera(folder)) return fs::weakly_canonical(folder / "data.csv").parent_path();
  return {};
}

struct Listed {
  std::vector<fs::path> pictures;
  std::vector<Time> captured;
};

Listed read_data(const fs::path& camera) {
  const fs::path file = camera / "data.csv";
  const auto lines = lines_of(file);
  Listed listed;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (line.empty() || line[0] == '#') continue;
    std::int64_t stamp = 0;
    const char* const last = line.data() + line.size();
    const auto [end, fault] = std::from_chars(line.data(), last, stamp);
    const auto name = line.find_first_not_of(" \t", static_cast<std::size_t>(end - line.data()) + 1);
    if (fault != std::errc{} || end == last || *end != ',' || name == std::string::npos)
      throw Error::at(file.string(), i + 1, "a line is a time in nanoseconds, a comma and a picture's name");
    if (const auto wrong = fault_of_time(listed.captured, time_ns(stamp)); !wrong.empty())
      throw Error::at(file.string(), i + 1, wrong);
    listed.captured.push_back(time_ns(stamp));
    listed.pictures.push_back(camera / "data" / line.substr(name, line.find_last_not_of(" \t") + 1 - name));
  }
  if (listed.pictures.empty()) throw Error(file.string() + ": there is no picture in it");
  return listed;
}

}  // namespace

bool recognises_euroc(const fs::path& path) { return !camera_of(path).empty(); }

FoundRecording find_euroc(const fs::path& path, const OpenOptions& options) {
  const fs::path camera = camera_of(path);
  if (camera.empty())
    throw Error(fmt::format("{} has no mav0/cam0/data.csv with a folder data beside it", path.string()));
  const bool below_mav0 = camera.parent_path().filename() == "mav0";
  const fs::path root = below_mav0 ? camera.parent_path().parent_path() : camera;
  FoundRecording found;
  found.description = read_description(root);
  if (below_mav0 && camera.filename() != "cam0") found.description.name += "-" + camera.filename().string();
  found.labels = root / "labels.csv";
  Listed listed = read_data(camera);
  OwnTimes own;
  own.captured = std::move(listed.captured);
  show(timed_pictures(camera / "data", std::move(listed.pictures), root, found.description, options, own),
       found);
  return found;
}

}  // namespace relock
