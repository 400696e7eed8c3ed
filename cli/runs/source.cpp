#include "cli/runs/source.h"

#include <fmt/format.h>

#include <sstream>

#include "cli/files.h"
#include "cli/recordings.h"
#include "core/error.h"
#include "core/toml_table.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "source.toml";

std::string relative_to(const fs::path& folder, const fs::path& path) {
  const fs::path way = fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(folder));
  return (way.empty() ? fs::absolute(path) : way).generic_string();
}

PlannedSequence read_source(const fs::path& folder) {
  const toml::table table = parse_toml(folder / kFile);
  const TomlTable source(table, (folder / kFile).string(), {"path", "labels", "rate_hz", "format", "topic"});
  PlannedSequence planned{folder / source.word("path").value_or(""), {}};
  if (const auto labels = source.word("labels")) planned.open.labels = folder / *labels;
  planned.open.rate_hz = source.positive("rate_hz");
  planned.open.format = source.word("format");
  planned.open.topic = source.word("topic");
  return planned;
}

Sequence checked(const StoredTruth& truth, const PlannedSequence& source) {
  Sequence sequence = open_sequence(source.path, source.open);
  if (truth.fingerprint && sequence.fingerprint != *truth.fingerprint)
    throw Error(fmt::format("{} is not what the runs were made on: its pictures, times or labels differ",
                            source.path.lexically_normal().string()));
  return sequence;
}

}  // namespace

void store_source(const fs::path& out, const std::string& recording, const PlannedSequence& source) {
  const fs::path folder = out / slug(recording) / "recording";
  toml::table table{{"path", relative_to(folder, recording_path(source.path))}};
  if (source.open.labels) table.insert("labels", relative_to(folder, *source.open.labels));
  if (source.open.rate_hz) table.insert("rate_hz", *source.open.rate_hz);
  if (source.open.format) table.insert("format", *source.open.format);
  if (source.open.topic) table.insert("topic", *source.open.topic);
  std::ostringstream text;
  text << table << "\n";
  if (!fs::exists(folder / kFile) || read_file(folder / kFile) != text.str())
    write_file(folder / kFile, text.str());
}

Sequence open_source(const StoredTruth& truth, const fs::path& path) {
  PlannedSequence source{recording_path(path), {}};
  if (fs::exists(truth.folder / kFile)) source.open = read_source(truth.folder).open;
  if (source.open.labels && !fs::exists(*source.open.labels)) source.open.labels.reset();
  return checked(truth, source);
}

Sequence open_source(const StoredTruth& truth) {
  if (fs::exists(truth.folder / kFile)) {
    const PlannedSequence source = read_source(truth.folder);
    if (fs::exists(source.path)) return checked(truth, source);
  }
  const fs::path embedded = embedded_recordings() / slug(truth.recording.name);
  if (!fs::exists(embedded))
    throw Error(fmt::format("the recording {} is not where it was; say where it is by --sequence",
                            truth.recording.name));
  return checked(truth, {embedded, {}});
}

}  // namespace relock
