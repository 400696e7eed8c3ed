#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/frame_source.h"
#include "core/recording.h"
#include "sequences/labels.h"

namespace relock {

/// Where capture times come from.
enum class TimesFrom : std::uint8_t {
  recorded,      ///< from the camera or the container
  stated_rate,   ///< made from a rate that the user or the recording states
  assumed_rate,  ///< made from the rate that is usual for the format; nobody stated it
};
std::string_view to_string(TimesFrom times);

/// Whether the truth beside a recording is wanted.
enum class Truth : std::uint8_t {
  read,
  ignored,  ///< whoever makes it: targets are those of recording.toml, and the fingerprint is of the pictures alone
};

/// A recording opened from disk: its truth, and as many passes over its frames as are asked for.
struct Sequence {
  Recording recording;
  Duration median_interval{};  ///< of all capture intervals; the period where there is one frame
  bool period_stated = false;  ///< the period was stated, not found from the capture times
  std::string format;          ///< its name, sequences/format.h
  TimesFrom times_from = TimesFrom::recorded;
  std::filesystem::path labels;  ///< where its labels.csv is, or would be
  std::string fingerprint;       ///< of pictures, times and labels: the same inputs, the same text
  std::function<std::unique_ptr<FrameSource>()> frames;  ///< a new pass from the first frame
};

struct OpenOptions {
  std::optional<std::filesystem::path> labels = {};  ///< else FOLDER/labels.csv; without either, no targets
  std::optional<double> rate_hz = {};                ///< for recordings that state no times
  LabelLimits limits = {};
  std::optional<std::string> format = {};  ///< else recognised (sequences/format.h)
  std::optional<std::string> topic = {};   ///< ROS bags: of the pictures; else the only one that has any
  Truth truth = Truth::read;
};

/// Opens the recording at `path`. Throws Error when it is none, or its labels are of another recording.
Sequence open_sequence(const std::filesystem::path& path, const OpenOptions& options = {});

/// Of one file's bytes. Throws Error when it cannot be read.
std::string file_fingerprint(const std::filesystem::path& path);
/// Of a text, whatever file it is in.
std::string text_fingerprint(std::string_view text);

/// Writes everything about a recording but its pictures into `folder`, which exists: recording.toml,
/// timestamps.csv and labels.csv.
void write_truth(const std::filesystem::path& folder, const Recording& recording);
/// Its recording.toml alone: what is known without its pictures and truth.
void write_description(const std::filesystem::path& folder, const Recording& recording);
/// Reads what `write_truth` wrote.
Recording read_truth(const std::filesystem::path& folder);

}  // namespace relock
