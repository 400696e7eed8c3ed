#include "sequences/open.h"

#include <fmt/format.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "sequences/format.h"
#include "sequences/timestamps.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

std::ifstream open_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) throw Error(fmt::format("{} cannot be read", path.string()));
  return in;
}

/// A hash of files' bytes and of words, order included (XXH3, 128 bits).
class Fingerprint {
 public:
  void add(std::string_view bytes) {
    const std::uint64_t size = bytes.size();
    XXH3_128bits_update(&state_, &size, sizeof size);
    XXH3_128bits_update(&state_, bytes.data(), bytes.size());
  }
  void add_file(const fs::path& path) {
    add_contents(path);
    add(path.filename().string());
  }
  void add_contents(const fs::path& path) {
    std::ifstream in = open_file(path);
    std::array<char, 1 << 16> buffer;
    while (in.read(buffer.data(), buffer.size()) || in.gcount() > 0)
      XXH3_128bits_update(&state_, buffer.data(), static_cast<std::size_t>(in.gcount()));
  }
  std::string text() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(&state_);
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  }

 private:
  static XXH3_state_t fresh() {
    XXH3_state_t state;
    XXH3_INITSTATE(&state);
    XXH3_128bits_reset(&state);
    return state;
  }
  XXH3_state_t state_ = fresh();
};

/// The recording.toml of what is known of a recording without its pictures.
std::string description_text(const Recording& recording) {
  std::string text =
      fmt::format("name = {}\nperiod_ns = {}\nwidth = {}\nheight = {}\n", toml_string(recording.name),
                  recording.period.count(), recording.picture.width, recording.picture.height);
  for (const Target& target : recording.targets) {
    text += fmt::format("\n[[target]]\nid = {}\n", toml_string(target.id));
    if (target.code) text += fmt::format("code = {}\n", toml_string(to_string(*target.code)));
    if (target.size_m) text += fmt::format("size_m = {}\n", *target.size_m);
  }
  return text;
}

/// Of the pictures' bytes, the times and the truth: of all that a run and its scores depend on.
std::string fingerprint(const std::vector<fs::path>& data, const Recording& recording) {
  Fingerprint print;
  for (const fs::path& file : data) print.add_file(file);
  std::ostringstream times, labels;
  write_timestamps(times, recording.captured);
  write_labels(labels, recording);
  print.add(description_text(recording));
  print.add(times.str());
  print.add(labels.str());
  return print.text();
}

/// Of the pictures' bytes alone, so that it stays the same when files are moved.
std::string fingerprint_of_contents(const std::vector<fs::path>& data) {
  Fingerprint print;
  for (const fs::path& file : data) print.add_contents(file);
  return print.text();
}

Duration period_of_recording(const Description& description, const OpenOptions& options,
                             std::span<const Time> captured) {
  if (options.rate_hz) return period_of(*options.rate_hz);
  if (description.period) return *description.period;
  return nominal_period(captured);
}

}  // namespace

std::string_view to_string(TimesFrom times) {
  constexpr std::string_view names[] = {"recorded", "stated rate", "assumed rate"};
  return names[static_cast<std::size_t>(times)];
}

Sequence open_sequence(const fs::path& path, const OpenOptions& options) {
  if (options.rate_hz && !(*options.rate_hz >= kLeastRate_hz && *options.rate_hz <= kMostRate_hz))
    throw Error(fmt::format("a rate of {} Hz is none; it must be from {} to {}", *options.rate_hz,
                            kLeastRate_hz, kMostRate_hz));
  const Format& format = format_of(path, options.format);
  FoundRecording found = format.find(path, options);
  const auto source = found.frames();

  Sequence sequence;
  sequence.format = format.name;
  sequence.times_from = found.times_from;
  sequence.recording.name = found.description.name;
  sequence.recording.picture = source->picture_size();
  sequence.recording.captured.assign(source->captured().begin(), source->captured().end());
  sequence.period_stated = options.rate_hz || found.description.period;
  sequence.recording.period = period_of_recording(found.description, options, source->captured());
  sequence.median_interval =
      source->captured().size() > 1 ? median_interval(source->captured()) : sequence.recording.period;

  sequence.labels = options.labels.value_or(found.labels);
  sequence.frames = found.frames;
  if (options.truth == Truth::ignored) {
    for (const auto& entry : found.description.targets) sequence.recording.targets.push_back(entry.target);
    sequence.recording.truth.resize(sequence.recording.frames() * sequence.recording.targets.size());
    sequence.fingerprint = fingerprint_of_contents(found.data);
    return sequence;
  }
  const fs::path& labels = sequence.labels;
  if (options.labels || fs::exists(labels)) {
    std::ifstream in = open_file(labels);
    read_labels(in, labels.string(), found.description, options.limits, sequence.recording);
  } else if (found.label) {
    found.label(options.limits, sequence.recording);
  }
  sequence.fingerprint = fingerprint(found.data, sequence.recording);
  return sequence;
}

std::string file_fingerprint(const fs::path& path) {
  Fingerprint print;
  print.add_file(path);
  return print.text();
}

std::string text_fingerprint(std::string_view text) {
  Fingerprint print;
  print.add(text);
  return print.text();
}

void write_description(const fs::path& folder, const Recording& recording) {
  std::ofstream toml(folder / "recording.toml", std::ios::binary);
  toml << description_text(recording);
  if (!toml.flush()) throw Error(fmt::format("{} cannot be written; is the disk full?", folder.string()));
}

void write_truth(const fs::path& folder, const Recording& recording) {
  write_description(folder, recording);
  std::ofstream times(folder / "timestamps.csv", std::ios::binary);
  write_timestamps(times, recording.captured);
  std::ofstream labels(folder / "labels.csv", std::ios::binary);
  write_labels(labels, recording);
  if (!times.flush() || !labels.flush())
    throw Error(fmt::format("{} cannot be written; is the disk full?", folder.string()));
}

Recording read_truth(const fs::path& folder) {
  const Description description = read_description(folder);
  if (!description.picture || !description.period)
    throw Error(
        fmt::format("{} must state width, height and period_ns", (folder / "recording.toml").string()));
  Recording recording;
  recording.name = description.name;
  recording.picture = *description.picture;
  recording.period = *description.period;
  recording.captured = read_timestamps(folder / "timestamps.csv").captured;
  const fs::path labels = folder / "labels.csv";
  std::ifstream in = open_file(labels);
  read_labels(in, labels.string(), description, {}, recording);
  return recording;
}

}  // namespace relock
