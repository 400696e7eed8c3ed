#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/json_text.h"
#include "sequences/labelling/key_frames.h"
#include "sequences/open.h"

namespace relock {

// labels.keys.json beside labels.csv (flight.labels.keys.json beside flight.labels.csv): the key frames that labels.csv
// is made from. Whoever has it can go on labelling.
//
//     { "format": "relock key frames", "version": 1,
//       "recording": { "name": "flight", "frames": 300, "width": 640, "height": 360, "pictures": "9f…" },
//       "max_gap_s": 2.0,
//       "labels": ["5c…", "a0…"],       fingerprints of the labels.csv made from it, and of the one before
//       "targets": [ { "id": "target", "keys": [
//         { "frame": 0, "state": "placed", "box": [x, y, width, height], "sigma_px": 1.0, "source": "hand" } ] } ] }
//
// An outline is "box", "quad" [x1, y1, …, y4] or "ellipse" [x, y, semi_major, semi_minor, angle_deg], in pixels with
// centres at integers (core/geometry.h).

/// Which recording key frames were made for. It is known by its pictures, so it may be moved and renamed.
struct KeyedRecording {
  std::string name;
  std::size_t frames = 0;
  Size picture;
  std::string pictures;  ///< fingerprint
};
KeyedRecording keyed_recording(const Sequence& sequence);

struct KeyDocument {
  KeyedRecording recording;
  double max_gap_s = 2.0;
  std::vector<std::string> labels;
  std::vector<KeyedTarget> targets;
};

/// Where the key frames of a labels.csv are.
std::filesystem::path key_file_of(const std::filesystem::path& labels);

std::string to_json_text(const KeyDocument& document);
/// Throws Error, one sentence, when the text is none, is broken, of a newer relock, or of another recording than
/// `recording`. `name` is what errors call it.
KeyDocument parse_keys(const std::string& text, const std::string& name, const KeyedRecording& recording);

/// One key frame, as the file and the page have it.
Json to_json(const KeyFrame& key);
/// Throws Error when it is none, or of a frame that the recording has not.
KeyFrame parse_key(const Json& json, const KeyedRecording& recording);
/// {"box": …}, {"quad": …} or {"ellipse": …}, added to `json`.
void add_outline(Json& json, const Outline& outline);

}  // namespace relock
