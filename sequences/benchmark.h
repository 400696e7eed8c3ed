#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording.h"
#include "sequences/description.h"
#include "sequences/labels.h"

// What the folders of tracking benchmarks have in common: text files with one line for each frame, an outline
// on each. Cells are separated by commas, tabs or spaces. A line with a NaN in it, and a box of no size, say
// that the target is not there.

namespace relock {

/// What a benchmark calls the top left pixel. A box of width 1 around it is Box{-0.5, -0.5, 1, 1} here.
enum class Origin : std::uint8_t { zero, one };

/// Lines of a file, without line ends and without empty lines at the end. Throws Error if it cannot be read.
std::vector<std::string> lines_of(const std::filesystem::path& file);
/// The numbers on a line, NaN among them. Throws Error at the line on anything else, and on what is no place
/// in a picture (beyond a million).
std::vector<double> numbers_of(std::string_view line, const std::string& file, std::size_t number);

/// Of left, top, width, height; nothing where the target is not there. Throws Error at the line on a negative
/// size and on other than four numbers.
std::optional<Box> box_of(std::span<const double> cells, Origin origin, const std::string& file,
                          std::size_t number);
/// A file of boxes, one a line.
using OutlineLines = std::vector<std::optional<Outline>>;
OutlineLines read_boxes(const std::filesystem::path& file, Origin origin);
/// A file of whole numbers from 0 to `most`, one a line.
std::vector<int> read_marks(const std::filesystem::path& file, int most);

/// Throws Error with both counts unless there are as many lines as pictures.
void expect_lines(const std::filesystem::path& file, std::size_t lines, const Recording& recording);
/// The same, but a single line will do as well: benchmarks that keep their truth secret publish the start.
void expect_all_or_start(const std::filesystem::path& file, std::size_t lines, const Recording& recording);

/// Labels of one target, from a frame on; other frames are unlabelled.
struct LabelledTarget {
  TargetId id;
  std::vector<TargetTruth> truth;
  std::size_t first_frame = 0;
};
/// A benchmark's boxes follow targets out of the picture: wholly outside is absent. Throws Error when none of
/// the outlines lies in the picture: they are of another recording.
std::vector<TargetTruth> truth_of_lines(const OutlineLines& lines, const std::filesystem::path& file,
                                        const LabelLimits& limits, const Recording& recording);
/// Fills targets and truth; what recording.toml says of a target is added by its id.
/// Throws Error when recording.toml speaks of a target that is not among them.
void put_targets(std::vector<LabelledTarget> targets, const Description& description, Recording& recording);

/// The number that a picture's name is ("0042.jpg": 42); nothing if it is none.
std::optional<std::int64_t> number_of(const std::filesystem::path& picture);
/// Whether a folder has a picture whose name is a number of so many digits.
bool has_numbered_picture(const std::filesystem::path& folder, std::size_t digits);

}  // namespace relock
