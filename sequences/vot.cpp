#include "sequences/vot.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "core/error.h"
#include "sequences/benchmark.h"
#include "sequences/image_folder.h"
#include "sequences/timestamps.h"
#include "sequences/vot_region.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate_hz = 30;
constexpr double kOccludedByTag = 0.1;
constexpr std::size_t kDigits = 8;  // of a picture's name
constexpr std::string_view kTruth = "groundtruth";
constexpr std::string_view kChannel = "channels.";

/// The ground truth files of a folder by their target's id.
std::map<std::string, fs::path> truth_files(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".txt" || !stem.starts_with(kTruth)) continue;
    const std::string rest = stem.substr(kTruth.size());
    if (rest.size() > 1 && rest[0] == '_' && !rest.starts_with("_rect"))  // that is OTB's
      files.emplace(rest.substr(1), entry.path());
  }
  if (files.empty() && fs::exists(folder / "groundtruth.txt"))
    files.emplace("target", folder / "groundtruth.txt");
  return files;
}

/// The file `sequence`: lines of key=value; other lines are passed over, as the toolkit does.
struct Properties {
  std::string file;
  std::map<std::string, std::string> values;
  std::map<std::string, std::size_t> lines;

  bool has(const std::string& key) const { return values.count(key) > 0; }

  std::optional<double> number(const std::string& key, double least, double most) const {
    if (!has(key)) return {};
    const std::string& text = values.at(key);
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc{} || end != text.data() + text.size() || !(value >= least && value <= most))
      throw Error::at(file, lines.at(key),
                      fmt::format("{} is \"{}\"; it must be a number from {} to {}", key, text, least, most));
    return value;
  }
};

Properties read_properties(const fs::path& file) {
  Properties read{file.string(), {}, {}};
  if (!fs::exists(file)) return read;
  const auto lines = lines_of(file);
  const auto trimmed = [](std::string_view text) {
    const auto begin = std::min(text.find_first_not_of(" \t"), text.size());
    return std::string(text.substr(begin, text.find_last_not_of(" \t") + 1 - begin));
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto equals = lines[i].find('=');
    if (equals == std::string::npos) continue;
    const std::string key = trimmed(std::string_view(lines[i]).substr(0, equals));
    read.values[key] = trimmed(std::string_view(lines[i]).substr(equals + 1));
    read.lines[key] = i + 1;
  }
  return read;
}

/// Also false for what is no path at all: the names come out of a file.
bool is_folder(const fs::path& path) {
  std::error_code fault;
  return fs::is_directory(path, fault);
}

/// The folder of the pictures of the channel that is read.
fs::path picture_folder(const fs::path& root, const Properties& properties) {
  const auto named = properties.values.find("channel.default");
  std::vector<std::string> candidates;
  if (named != properties.values.end()) candidates.push_back(std::string(kChannel) + named->second);
  candidates.push_back("channels.color");
  for (const auto& [key, value] : properties.values)
    if (key.starts_with(kChannel)) candidates.push_back(key);
  for (const std::string& key : candidates) {
    if (!properties.has(key)) continue;
    std::string pattern = properties.values.at(key);
    std::replace(pattern.begin(), pattern.end(), '\\', '/');
    const fs::path folder = root / pattern;
    return is_folder(folder) ? folder : folder.parent_path();
  }
  return fs::is_directory(root / "color") ? root / "color" : root;
}

std::vector<fs::path> pictures_of(const fs::path& folder, const Properties& properties) {
  if (!is_folder(folder))
    throw Error(fmt::format("{} says that the pictures are in {}, and there is no such folder",
                            properties.file, folder.string()));
  auto pictures = pictures_in(folder);
  const auto length = properties.number("length", 1, 1e9);
  if (!length) return pictures;
  const auto count = static_cast<std::size_t>(*length);
  if (pictures.size() < count)
    throw Error(fmt::format("{} says that there are {} pictures, and there are {} in {}", properties.file,
                            count, pictures.size(), folder.string()));
  pictures.resize(count);
  return pictures;
}

std::vector<Time> read_times(const fs::path& file, std::size_t pictures) {
  std::vector<Time> captured;
  if (!fs::exists(file)) return captured;
  const auto lines = lines_of(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Time time = time_of_seconds(lines[i], file.string(), i + 1);
    if (const auto wrong = fault_of_time(captured, time); !wrong.empty())
      throw Error::at(file.string(), i + 1, wrong);
    captured.push_back(time);
  }
  if (captured.size() != pictures)
    throw Error(
        fmt::format("{}: there are {} times for {} pictures", file.string(), captured.size(), pictures));
  return captured;
}

void label(const fs::path& folder, const Description& description, const LabelLimits& limits,
           Recording& recording) {
  std::vector<int> occluded;
  if (const fs::path tag = folder / "occlusion.tag"; fs::exists(tag)) {
    occluded = read_marks(tag, 1);
    expect_lines(tag, occluded.size(), recording);
  }
  std::vector<LabelledTarget> targets;
  for (const auto& [id, file] : truth_files(folder)) {
    const auto lines = lines_of(file);
    OutlineLines regions;
    for (std::size_t i = 0; i < lines.size(); ++i)
      regions.push_back(vot_region(lines[i], file.string(), i + 1));
    expect_all_or_start(file, regions.size(), recording);
    targets.push_back({id, truth_of_lines(regions, file, limits, recording)});
    auto& truth = targets.back().truth;
    for (std::size_t i = 0; i < std::min(truth.size(), occluded.size()); ++i)
      if (occluded[i] == 1 && truth[i].outline) truth[i].occluded_fraction = kOccludedByTag;
  }
  put_targets(std::move(targets), description, recording);
}

}  // namespace

bool recognises_vot(const fs::path& path) {
  if (!fs::is_directory(path)) return false;
  const bool truth = !truth_files(path).empty(), color = fs::is_directory(path / "color");
  if (fs::is_regular_file(path / "sequence")) return truth || color;
  return truth && (color || has_numbered_picture(path, kDigits));
}

FoundRecording find_vot(const fs::path& path, const OpenOptions& options) {
  if (!fs::is_directory(path)) throw Error(fmt::format("{} is no folder of a sequence", path.string()));
  FoundRecording found;
  found.description = read_description(path);
  found.labels = path / "labels.csv";
  const Properties properties = read_properties(path / "sequence");
  const fs::path folder = picture_folder(path, properties);
  auto pictures = pictures_of(folder, properties);
  OwnTimes own;
  if (!fs::exists(path / "timestamps.csv"))
    own.captured = read_times(path / "timestamp.value", pictures.size());
  own.stated_rate_hz = properties.number("fps", kLeastRate_hz, kMostRate_hz);
  own.assumed_rate_hz = kUsualRate_hz;
  show(timed_pictures(folder, std::move(pictures), path, found.description, options, own), found);
  if (!truth_files(path).empty())
    found.label = [path, description = found.description](const LabelLimits& limits, Recording& recording) {
      label(path, description, limits, recording);
    };
  return found;
}

}  // namespace relock
