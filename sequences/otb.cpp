#include "sequences/otb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/error.h"
#include "sequences/benchmark.h"
#include "sequences/description.h"
#include "sequences/image_folder.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate_hz = 30;

/// A sequence whose label file is shorter than its folder of pictures.
struct PartlyLabelled {
  std::string_view name;
  std::int64_t first_picture;
  std::size_t lines;
};
constexpr std::array kPartlyLabelled{PartlyLabelled{"David", 300, 471}, PartlyLabelled{"Diving", 1, 215},
                                     PartlyLabelled{"Football1", 1, 74}, PartlyLabelled{"Freeman3", 1, 460},
                                     PartlyLabelled{"Freeman4", 1, 283}};

/// The number in groundtruth_rect.NUMBER.txt, 0 for groundtruth_rect.txt; nothing for other files.
std::optional<std::int64_t> target_number(const fs::path& file) {
  if (file.extension() != ".txt") return {};
  const fs::path stem = file.stem();
  if (stem == "groundtruth_rect") return 0;
  if (stem.stem() != "groundtruth_rect") return {};
  return number_of(stem.extension().string().substr(1) + ".txt");
}

/// The label files of a folder by their number.
std::map<std::int64_t, fs::path> label_files(const fs::path& folder) {
  std::map<std::int64_t, fs::path> files;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable))
    if (const auto number = target_number(entry.path())) files.emplace(*number, entry.path());
  return files;
}

/// Rank of the frame that the first of `lines` is of.
std::size_t first_labelled(const fs::path& folder, const fs::path& file, std::size_t lines,
                           const std::vector<fs::path>& pictures, const Recording& recording) {
  for (const PartlyLabelled& known : kPartlyLabelled) {
    if (folder_name(folder) != known.name || lines != known.lines || lines >= pictures.size()) continue;
    const auto first = std::find_if(pictures.begin(), pictures.end(), [&](const fs::path& picture) {
      return number_of(picture) == known.first_picture;
    });
    const auto rank = static_cast<std::size_t>(first - pictures.begin());
    if (rank + lines <= pictures.size()) return rank;
  }
  expect_lines(file, lines, recording);
  return 0;
}

void label(const fs::path& folder, const std::vector<fs::path>& pictures, const Description& description,
           const LabelLimits& limits, Recording& recording) {
  std::vector<LabelledTarget> targets;
  for (const auto& [number, file] : label_files(folder)) {
    const OutlineLines lines = read_boxes(file, Origin::one);
    if (lines.empty()) continue;
    const std::size_t first = first_labelled(folder, file, lines.size(), pictures, recording);
    targets.push_back({number == 0 ? "target" : std::to_string(number),
                       truth_of_lines(lines, file, limits, recording), first});
  }
  if (targets.empty()) throw Error(fmt::format("{}: groundtruth_rect.txt is empty", folder.string()));
  if (targets.size() == 1) targets[0].id = "target";
  put_targets(std::move(targets), description, recording);
}

}  // namespace

bool recognises_otb(const fs::path& path) {
  return fs::is_directory(path / "img") && !label_files(path).empty();
}

FoundRecording find_otb(const fs::path& path, const OpenOptions& options) {
  const fs::path images = path / "img";
  if (!fs::is_directory(images)) throw Error(fmt::format("{} has no folder img of pictures", path.string()));
  FoundRecording found;
  found.description = read_description(path);
  found.labels = path / "labels.csv";
  OwnTimes own;
  own.assumed_rate_hz = kUsualRate_hz;
  auto timed = timed_pictures(images, pictures_in(images), path, found.description, options, own);
  if (!label_files(path).empty())
    found.label = [path, pictures = timed.pictures, description = found.description](
                      const LabelLimits& limits, Recording& recording) {
      label(path, pictures, description, limits, recording);
    };
  show(std::move(timed), found);
  return found;
}

}  // namespace relock
