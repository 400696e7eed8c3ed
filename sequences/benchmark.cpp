#include "sequences/benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "core/outline_csv.h"
#include "sequences/image_folder.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthest_px = 1e6;

bool is_space(char c) { return c == ' ' || c == '\t'; }

/// Cells of a line: between commas, and between white space where there is no comma.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  std::size_t at = 0;
  const auto skip_space = [&] {
    while (at < line.size() && is_space(line[at])) ++at;
  };
  for (skip_space(); at < line.size();) {
    const std::size_t begin = at;
    while (at < line.size() && !is_space(line[at]) && line[at] != ',') ++at;
    cells.push_back(line.substr(begin, at - begin));
    skip_space();
    if (at < line.size() && line[at] == ',') {
      ++at;
      skip_space();
      if (at == line.size()) cells.emplace_back();
    }
  }
  return cells;
}

}  // namespace

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) throw Error(fmt::format("{} cannot be read", file.string()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (lines.empty() && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // a byte order mark
    lines.push_back(std::move(line));
  }
  const auto blank = [](const std::string& line) { return std::all_of(line.begin(), line.end(), is_space); };
  while (!lines.empty() && blank(lines.back())) lines.pop_back();
  return lines;
}

std::vector<double> numbers_of(std::string_view line, const std::string& file, std::size_t number) {
  std::vector<double> numbers;
  for (const std::string_view cell : cells_of(line)) {
    double value = 0;
    const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (cell.empty() || fault != std::errc{} || end != cell.data() + cell.size())
      throw Error::at(file, number, fmt::format("\"{}\" is no number", cell));
    if (std::abs(value) > kFarthest_px)
      throw Error::at(file, number, fmt::format("{} is too large for a picture", cell));
    numbers.push_back(value);
  }
  if (numbers.empty()) throw Error::at(file, number, "this line is empty");
  return numbers;
}

std::optional<Box> box_of(std::span<const double> cells, Origin origin, const std::string& file,
                          std::size_t number) {
  if (cells.size() != 4)
    throw Error::at(file, number, fmt::format("a box is x, y, width, height; there are {}", cells.size()));
  if (std::any_of(cells.begin(), cells.end(), [](double cell) { return std::isnan(cell); })) return {};
  if (cells[2] < 0 || cells[3] < 0)
    throw Error::at(file, number, fmt::format("a box of {} by {} is none", cells[2], cells[3]));
  if (cells[2] < kSmallestOutline_px || cells[3] < kSmallestOutline_px) return {};
  const double corner = origin == Origin::one ? 1.5 : 0.5;  // of the top left pixel's corner
  return Box{cells[0] - corner, cells[1] - corner, cells[2], cells[3]};
}

OutlineLines read_boxes(const fs::path& file, Origin origin) {
  const auto lines = lines_of(file);
  OutlineLines boxes;
  for (std::size_t i = 0; i < lines.size(); ++i)
    boxes.push_back(box_of(numbers_of(lines[i], file.string(), i + 1), origin, file.string(), i + 1));
  return boxes;
}

std::vector<int> read_marks(const fs::path& file, int most) {
  const auto lines = lines_of(file);
  std::vector<int> marks;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto cells = numbers_of(lines[i], file.string(), i + 1);
    if (cells.size() != 1 || !(cells[0] >= 0 && cells[0] <= most) || cells[0] != std::floor(cells[0]))
      throw Error::at(file.string(), i + 1, fmt::format("\"{}\" is none of 0 to {}", lines[i], most));
    marks.push_back(static_cast<int>(cells[0]));
  }
  return marks;
}

void expect_lines(const fs::path& file, std::size_t lines, const Recording& recording) {
  if (lines != recording.frames())
    throw Error(
        fmt::format("{}: there are {} lines for the {} pictures of {}; were these labels made for "
                    "another recording?",
                    file.string(), lines, recording.frames(), recording.name));
}

void expect_all_or_start(const fs::path& file, std::size_t lines, const Recording& recording) {
  if (lines != 1) expect_lines(file, lines, recording);
}

std::vector<TargetTruth> truth_of_lines(const OutlineLines& lines, const fs::path& file,
                                        const LabelLimits& limits, const Recording& recording) {
  TargetTruth absent;
  absent.label = Label::absent;
  absent.visible_fraction = 0;
  std::vector<TargetTruth> truth;
  for (const auto& outline : lines)
    truth.push_back(outline ? truth_of_outline(*outline, recording.picture, limits) : absent);
  const bool any = std::any_of(lines.begin(), lines.end(), [](const auto& line) { return line.has_value(); });
  if (any && std::none_of(truth.begin(), truth.end(), [](const auto& t) { return t.outline.has_value(); }))
    throw Error(
        fmt::format("{}: all outlines lie outside the pictures of {}x{}; were these labels made for "
                    "another recording?",
                    file.string(), recording.picture.width, recording.picture.height));
  return truth;
}

void put_targets(std::vector<LabelledTarget> targets, const Description& description, Recording& recording) {
  std::vector<std::string> ids;
  for (const LabelledTarget& target : targets) ids.push_back(target.id);
  for (const auto& entry : description.targets)
    if (std::find(ids.begin(), ids.end(), entry.target.id) == ids.end())
      throw Error(fmt::format("recording.toml of {} speaks of a target \"{}\", and the labels are of {}",
                              recording.name, entry.target.id, fmt::join(ids, ", ")));
  const auto entry_of = [&](const LabelledTarget& target) {
    return std::find_if(description.targets.begin(), description.targets.end(),
                        [&](const auto& entry) { return entry.target.id == target.id; });
  };
  recording.targets.clear();
  for (const LabelledTarget& target : targets) {
    const auto entry = entry_of(target);
    recording.targets.push_back(entry == description.targets.end() ? Target{target.id} : entry->target);
  }
  recording.truth.assign(recording.frames() * targets.size(), TargetTruth{});
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const auto entry = entry_of(targets[t]);
    const bool own_sigma = entry != description.targets.end() && entry->sigma_px;
    for (std::size_t i = 0; i < targets[t].truth.size(); ++i) {
      TargetTruth& truth = recording.truth_of(targets[t].first_frame + i, t);
      truth = std::move(targets[t].truth[i]);
      truth.sigma_px = own_sigma ? *entry->sigma_px : description.sigma_px;
    }
  }
}

std::optional<std::int64_t> number_of(const fs::path& picture) {
  const std::string name = picture.stem().string();
  std::int64_t number = 0;
  const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (name.empty() || fault != std::errc{} || end != name.data() + name.size()) return {};
  return number;
}

bool has_numbered_picture(const fs::path& folder, std::size_t digits) {
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable))
    if (is_picture(entry.path()) && entry.path().stem().string().size() == digits && number_of(entry.path()))
      return true;
  return false;
}

}  // namespace relock
