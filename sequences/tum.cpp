#include "sequences/tum.h"

#include <fmt/format.h>

#include "core/error.h"
#include "sequences/benchmark.h"
#include "sequences/image_folder.h"
#include "sequences/timestamps.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSpace = " \t";

}  // namespace

bool recognises_tum(const fs::path& path) { return fs::is_regular_file(path / "rgb.txt"); }

FoundRecording find_tum(const fs::path& path, const OpenOptions& options) {
  FoundRecording found;
  found.description = read_description(path);
  found.labels = path / "labels.csv";
  const fs::path file = path / "rgb.txt";
  const auto lines = lines_of(file);
  OwnTimes own;
  std::vector<fs::path> pictures;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = lines[i];
    const auto begin = line.find_first_not_of(kSpace);
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    const auto end = std::min(line.find_first_of(kSpace, begin), line.size());
    const auto name = line.find_first_not_of(kSpace, end);
    if (name == std::string_view::npos)
      throw Error::at(file.string(), i + 1, "a line is a time in seconds and a picture's name");
    const Time captured = time_of_seconds(line.substr(begin, end - begin), file.string(), i + 1);
    if (const auto wrong = fault_of_time(own.captured, captured); !wrong.empty())
      throw Error::at(file.string(), i + 1, wrong);
    own.captured.push_back(captured);
    pictures.push_back(path / line.substr(name, line.find_last_not_of(kSpace) + 1 - name));
  }
  if (pictures.empty()) throw Error(file.string() + ": there is no picture in it");
  const fs::path folder = pictures.front().parent_path();
  show(timed_pictures(folder, std::move(pictures), path, found.description, options, own), found);
  return found;
}

}  // namespace relock
