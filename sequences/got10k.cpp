#include "sequences/got10k.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.h"
#include "sequences/benchmark.h"
#include "sequences/description.h"
#include "sequences/image_folder.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate_hz = 10;
constexpr int kWholeCover = 8;
constexpr std::size_t kDigits = 8;  // of a picture's name

/// The rate in meta_info.ini ("anno_fps: 10Hz", "anno_fps = 30fps"); nothing without one.
std::optional<double> annotated_rate(const fs::path& file) {
  if (!fs::exists(file)) return {};
  const auto lines = lines_of(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (!line.starts_with("anno_fps")) continue;
    const auto begin = std::min(line.find_first_not_of(" \t:=", sizeof "anno_fps" - 1), line.size());
    double rate = 0;
    std::from_chars(line.data() + begin, line.data() + line.size(), rate);
    if (!(rate >= kLeastRate_hz && rate <= kMostRate_hz))
      throw Error::at(file.string(), i + 1, "anno_fps is no rate");
    return rate;
  }
  return {};
}

void apply_cover(int cover, Size picture, const LabelLimits& limits, TargetTruth& truth) {
  if (!truth.outline) return;
  truth.visible_fraction = static_cast<double>(cover) / kWholeCover;
  truth.occluded_fraction =
      std::max(0.0, share_inside(*truth.outline, picture_box(picture)) - truth.visible_fraction);
  truth.label = cover == 0 ? Label::unlabelled : label_of(truth.visible_fraction, limits);
}

void label(const fs::path& folder, const Description& description, const LabelLimits& limits,
           Recording& recording) {
  const fs::path boxes = folder / "groundtruth.txt";
  OutlineLines lines = read_boxes(boxes, Origin::one);
  expect_all_or_start(boxes, lines.size(), recording);
  const auto marks = [&](const char* name, int most) {
    const fs::path file = folder / name;
    auto read = fs::exists(file) ? read_marks(file, most) : std::vector<int>{};
    if (!read.empty() || fs::exists(file)) expect_lines(file, read.size(), recording);
    return read;
  };
  const auto absence = marks("absence.label", 1), cover = marks("cover.label", kWholeCover);
  for (std::size_t i = 0; i < lines.size() && !absence.empty(); ++i)
    if (absence[i] == 1) lines[i].reset();
  auto truth = truth_of_lines(lines, boxes, limits, recording);
  for (std::size_t i = 0; i < lines.size() && !cover.empty(); ++i)
    apply_cover(cover[i], recording.picture, limits, truth[i]);
  put_targets({{"target", std::move(truth)}}, description, recording);
}

}  // namespace

bool recognises_got10k(const fs::path& path) {
  if (!fs::is_regular_file(path / "groundtruth.txt") || fs::exists(path / "sequence")) return false;
  const bool own = fs::exists(path / "meta_info.ini") || fs::exists(path / "absence.label") ||
                   fs::exists(path / "cover.label") || folder_name(path).starts_with("GOT-10k");
  return own && has_numbered_picture(path, kDigits);
}

FoundRecording find_got10k(const fs::path& path, const OpenOptions& options) {
  if (!fs::is_directory(path)) throw Error(fmt::format("{} is no folder of pictures", path.string()));
  FoundRecording found;
  found.description = read_description(path);
  found.labels = path / "labels.csv";
  OwnTimes own;
  own.stated_rate_hz = annotated_rate(path / "meta_info.ini");
  own.assumed_rate_hz = kUsualRate_hz;
  show(timed_pictures(path, pictures_in(path), path, found.description, options, own), found);
  if (fs::exists(path / "groundtruth.txt"))
    found.label = [path, description = found.description](const LabelLimits& limits, Recording& recording) {
      label(path, description, limits, recording);
    };
  return found;
}

}  // namespace relock
