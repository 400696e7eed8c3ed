#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/labelling/key_file.h"
#include "sequences/labelling/fill.h"
#include "sequences/labelling/next_click.h"

namespace relock {

/// What is known of each target's frames beside the labels: how much the picture under the label is like that of the
/// last key frame (cli/labelling/likeness.h).
using Likenesses = std::vector<std::vector<double>>;

/// A recording on the labeller's desk: its key frames, the labels that follow from them, and both on disk.
///
/// Whatever is done is on disk before `edit` returns, each file whole: whoever is killed loses nothing. Key frames are
/// written first; a labels.csv that is a step behind is known by its fingerprint and made again at the next opening.
class LabelDesk {
 public:
  /// `max_gap_s`: else that of the key frames. Throws Error, one sentence, when labels.csv is not made from key frames that belong to the recording, or the key
  /// frames are broken: nothing that was not made here is ever overwritten.
  LabelDesk(Sequence sequence, std::optional<double> max_gap_s);

  /// {"do": "key", "target": id, …a key frame as in the file…}, {"do": "take", "target": id, "frame": n},
  /// {"do": "target", "id": id}, {"do": "undo"}. Throws Error when it cannot be done; then nothing has changed.
  void edit(const Json& request);

  /// All that the page shows, but for pictures.
  Json state(const Likenesses& likenesses) const;

  const Sequence& sequence() const { return sequence_; }
  const KeyDocument& document() const { return document_; }
  const std::vector<FilledTarget>& filled() const { return filled_; }
  const std::filesystem::path& labels_file() const { return sequence_.labels; }
  const std::filesystem::path& keys_file() const { return keys_file_; }
  FillOptions options() const;
  /// Counts what was done: as long as it is the same, so is everything.
  std::size_t version() const { return version_; }

 private:
  void open();
  void change(std::vector<KeyedTarget> targets);
  void fill_changed(const std::vector<KeyedTarget>& before);
  void save();
  std::string labels_text() const;

  Sequence sequence_;
  std::filesystem::path keys_file_;
  KeyDocument document_;
  std::vector<FilledTarget> filled_;
  std::vector<std::vector<KeyedTarget>> done_;  ///< what was there before each change
  std::string on_disk_;                         ///< the key frames as they were written last
  std::size_t version_ = 0;
};

/// The recording's labels as they follow from key frames.
Recording labelled(const Sequence& sequence, std::span<const KeyedTarget> targets,
                   std::span<const FilledTarget> filled);

}  // namespace relock
