#include "sequences/timestamps.h"

#include <fmt/format.h>

#include <fstream>

#include "core/csv.h"
#include "core/error.h"

namespace relock {
namespace {
constexpr Duration kLongestInterval = std::chrono::hours(24);
}

Timestamps read_timestamps(std::istream& in, const std::string& file) {
  CsvReader rows(in, file);
  const std::vector<std::string> known{"timestamp_ns", "file", "frame"};
  rows.expect_only(known);
  const auto time = rows.column("timestamp_ns");
  const auto picture = rows.optional_column("file");
  Timestamps read;
  while (rows.next()) {
    const Time captured = time_ns(rows.whole(time));
    if (!read.captured.empty() && captured <= read.captured.back())
      rows.fail(fmt::format("the time {} {} the one before ({}); capture times must rise", ns(captured),
                            captured == read.captured.back() ? "repeats" : "goes back behind",
                            ns(read.captured.back())));
    if (!read.captured.empty() && captured - read.captured.back() > kLongestInterval)
      rows.fail(fmt::format("the time jumps by {:.0f} s; was the camera's clock set here?",
                            seconds(captured - read.captured.back())));
    read.captured.push_back(captured);
    if (picture != CsvReader::missing && rows.text(picture).empty())
      rows.fail("column file: a name is missing");
    if (picture != CsvReader::missing) read.files.emplace_back(rows.text(picture));
  }
  if (read.captured.empty()) throw Error(file + ": there is no frame in it");
  return read;
}

Timestamps read_timestamps(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw Error(fmt::format("{} cannot be read", path.string()));
  return read_timestamps(in, path.string());
}

void write_timestamps(std::ostream& out, const std::vector<Time>& captured) {
  out << "timestamp_ns\n";
  for (const Time time : captured) out << ns(time) << '\n';
}

}  // namespace relock
