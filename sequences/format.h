#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/frame_source.h"
#include "core/recording.h"
#include "sequences/description.h"
#include "sequences/open.h"

namespace relock {

/// What a format's reader finds at a path: all that is particular to the format. `open_sequence` makes the
/// rest of it: period, labels.csv in place of the format's own labels, fingerprint.
struct FoundRecording {
  Description description;       ///< of recording.toml beside it, the name filled in at least
  std::filesystem::path labels;  ///< where labels.csv is, if there is one
  std::vector<std::filesystem::path>
      data;  ///< the files that pictures come from, sorted: a run depends on them
  TimesFrom times_from = TimesFrom::recorded;
  /// The format's own labels: fills targets and truth of a recording whose frames, picture and name are
  /// there. Empty: the format has none, or this recording has none.
  std::function<void(const LabelLimits&, Recording&)> label;
  std::function<std::unique_ptr<FrameSource>()> frames;  ///< a new pass from the first frame
};

/// A way in which recordings are kept on disk.
struct Format {
  std::string_view name;      ///< as --format takes it
  std::string_view sentence;  ///< what it looks like on disk
  /// Whether the path looks like it, from names alone: nothing is read.
  bool (*recognises)(const std::filesystem::path& path);
  /// Throws Error when it cannot be read, with the file and line at fault.
  FoundRecording (*find)(const std::filesystem::path& path, const OpenOptions& options);
};

/// All formats, in the order in which they are tried: the particular before the general.
std::span<const Format> formats();

/// The format called `name`, else the first that recognises `path`. Throws Error when there is none.
const Format& format_of(const std::filesystem::path& path, const std::optional<std::string>& name);

}  // namespace relock
