#include "sequences/uav123.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.h"
#include "sequences/benchmark.h"
#include "sequences/image_folder.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate_hz = 30, kReducedRate_hz = 10;
constexpr std::size_t kDigits = 6;  // of a picture's name

/// Pictures and the annotation of some of them.
struct Place {
  fs::path pictures;
  fs::path annotation;  ///< empty: there is none
  fs::path root;        ///< of the benchmark; empty for a flat copy
  bool opened_as_file = false;
};

/// car1_2 is a piece of car1; nothing for a name without a number behind a line.
std::optional<std::string> cut_from(const std::string& name) {
  const auto line = name.rfind('_');
  if (line == std::string::npos || line == 0 || !number_of(name.substr(line + 1) + ".txt")) return {};
  return name.substr(0, line);
}

/// Names of the annotations of pieces of the folder of pictures `name`.
std::vector<std::string> pieces(const fs::path& annotations, const std::string& name) {
  std::vector<std::string> all;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(annotations, unreadable))
    if (entry.path().extension() == ".txt" && cut_from(entry.path().stem().string()) == name)
      all.push_back(entry.path().filename().string());
  std::sort(all.begin(), all.end());
  return all;
}

/// The folder of pictures of ROOT/anno/SET/NAME.txt; nothing for another file.
std::optional<Place> place_of_annotation(const fs::path& given) {
  const fs::path file = fs::weakly_canonical(given);
  const fs::path annotations = file.parent_path().parent_path();
  if (file.extension() != ".txt" || annotations.filename() != "anno") return {};
  const fs::path root = annotations.parent_path();
  const std::string name = file.stem().string();
  for (const std::string& folder : {name, cut_from(name).value_or(name)})
    for (const fs::path& set : {file.parent_path().filename(), fs::path("UAV123")})
      if (const fs::path pictures = root / "data_seq" / set / folder; fs::is_directory(pictures))
        return Place{pictures, file, root, true};
  return {};
}

Place place_of_folder(const fs::path& given) {
  const fs::path folder = fs::weakly_canonical(given / "x").parent_path();
  Place place{folder, {}, {}};
  const std::string name = folder.filename().string(), file = name + ".txt";
  const fs::path set = folder.parent_path();
  if (set.parent_path().filename() == "data_seq") place.root = set.parent_path().parent_path();
  for (const fs::path& candidate : {folder / file, set / file, place.root / "anno" / set.filename() / file})
    if (place.annotation.empty() && fs::is_regular_file(candidate)) place.annotation = candidate;
  return place;
}

struct Range {
  std::int64_t first, last;
};

/// The number behind `key` in `text` from `at` on.
std::optional<std::int64_t> number_behind(const std::string& text, std::string_view key, std::size_t at,
                                          std::size_t end) {
  at = text.find(key, at);
  if (at == std::string::npos || at >= end) return {};
  std::int64_t number = 0;
  const char* const begin = text.data() + at + key.size();
  if (std::from_chars(begin, text.data() + text.size(), number).ec != std::errc{}) return {};
  return number;
}

/// What configSeqs.m says of an annotation with so many lines: the benchmark's sets may share names.
std::optional<Range> configured_range(const fs::path& file, const std::string& name, std::size_t lines) {
  if (!fs::exists(file)) return {};
  std::string text;
  for (const std::string& line : lines_of(file)) text += line;
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t'; }),
             text.end());
  const std::string entry = fmt::format("'name','{}'", name);
  for (auto at = text.find(entry); at != std::string::npos; at = text.find(entry, at + 1)) {
    const auto end = std::min(text.find("'name',", at + 1), text.size());
    const auto first = number_behind(text, "'startFrame',", at, end);
    const auto last = number_behind(text, "'endFrame',", at, end);
    if (!first || !last || *first < 0 || *last < *first)
      throw Error(fmt::format("{}: {} has no startFrame and endFrame", file.string(), name));
    if (static_cast<std::uint64_t>(*last - *first) + 1 == lines) return Range{*first, *last};
  }
  return {};
}

/// Leaves the pictures whose numbers are in the range.
TimedPictures within(const Range& range, const TimedPictures& all) {
  TimedPictures part;
  part.times_from = all.times_from;
  for (std::size_t i = 0; i < all.pictures.size(); ++i) {
    const auto number = number_of(all.pictures[i]);
    if (!number || *number < range.first || *number > range.last) continue;
    part.pictures.push_back(all.pictures[i]);
    part.captured.push_back(all.captured[i]);
  }
  return part;
}

TimedPictures annotated_pictures(const Place& place, TimedPictures all) {
  if (place.annotation.empty() || place.root.empty()) return all;
  const std::string name = place.annotation.stem().string();
  const std::size_t lines = lines_of(place.annotation).size();
  const fs::path config = place.root / "configSeqs.m";
  if (const auto range = configured_range(config, name, lines)) return within(*range, all);
  if (cut_from(name) == place.pictures.filename().string())
    throw Error(fmt::format("{} is a piece of {}, and {} does not say which pictures its {} lines are of",
                            place.annotation.string(), place.pictures.string(), config.string(), lines));
  return all;
}

void label(const fs::path& file, const Description& description, const LabelLimits& limits,
           Recording& recording) {
  const OutlineLines lines = read_boxes(file, Origin::one);
  expect_lines(file, lines.size(), recording);
  put_targets({{"target", truth_of_lines(lines, file, limits, recording)}}, description, recording);
}

std::vector<std::string> pieces_of(const Place& place) {
  if (place.root.empty()) return {};
  return pieces(place.root / "anno" / place.pictures.parent_path().filename(),
                place.pictures.filename().string());
}

}  // namespace

bool recognises_uav123(const fs::path& path) {
  if (fs::is_regular_file(path)) return place_of_annotation(path).has_value();
  if (!has_numbered_picture(path, kDigits)) return false;
  const Place place = place_of_folder(path);
  return !place.annotation.empty() || !pieces_of(place).empty();
}

FoundRecording find_uav123(const fs::path& path, const OpenOptions& options) {
  const auto place = fs::is_directory(path) ? place_of_folder(path) : place_of_annotation(path);
  if (!place)
    throw Error(
        fmt::format("{} is neither a folder of pictures nor a file ROOT/anno/SET/NAME.txt of one in "
                    "ROOT/data_seq",
                    path.string()));
  FoundRecording found;
  found.description = read_description(place->pictures);
  if (place->opened_as_file)
    found.description.name = place->annotation.stem().string();
  else
    found.labels = place->pictures / "labels.csv";
  const auto cut = pieces_of(*place);
  if (place->annotation.empty() && !cut.empty() && !options.labels && !fs::exists(found.labels))
    throw Error(fmt::format("{} is cut into pieces; open one of them by its annotation, {} in {}",
                            path.string(), fmt::join(cut, " or "),
                            (place->root / "anno" / place->pictures.parent_path().filename()).string()));
  OwnTimes own;
  const bool reduced = place->pictures.parent_path().filename().string().ends_with("10fps");
  own.assumed_rate_hz = reduced ? kReducedRate_hz : kUsualRate_hz;
  auto timed = timed_pictures(place->pictures, pictures_in(place->pictures), place->pictures,
                              found.description, options, own);
  show(annotated_pictures(*place, std::move(timed)), found);
  if (!place->annotation.empty())
    found.label = [file = place->annotation, description = found.description](const LabelLimits& limits,
                                                                              Recording& recording) {
      label(file, description, limits, recording);
    };
  return found;
}

}  // namespace relock
