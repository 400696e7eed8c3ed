#include "sequences/timestamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

#include "core/csv.h"
#include "core/error.h"

namespace relock {
namespace {
constexpr Duration kLongestInterval = std::chrono::hours(24);
constexpr std::size_t kMostSecondsDigits = 10;
constexpr std::size_t kNanosecondDigits = 9;
}  // namespace

std::string fault_of_time(const std::vector<Time>& before, Time captured) {
  if (before.empty()) return "";
  const Time last = before.back();
  if (captured <= last)
    return fmt::format("the time {} {} the one before ({}); capture times must rise", ns(captured),
                       captured == last ? "repeats" : "goes back behind", ns(last));
  // Without sign a difference cannot overflow, however far apart the two are.
  const auto jump = static_cast<std::uint64_t>(ns(captured)) - static_cast<std::uint64_t>(ns(last));
  if (jump > static_cast<std::uint64_t>(kLongestInterval.count()))
    return fmt::format("the time jumps by {:.0f} s; was the camera's clock set here?",
                       static_cast<double>(jump) / 1e9);
  return "";
}

Time time_of_seconds(std::string_view text, const std::string& file, std::size_t line) {
  const auto digits = [](std::string_view part) {
    return std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  const auto point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  std::string fraction(text.substr(std::min(point + 1, text.size())));
  while (fraction.size() > kNanosecondDigits && fraction.back() == '0') fraction.pop_back();
  if (whole.empty() || whole.size() > kMostSecondsDigits || !digits(whole) || !digits(fraction))
    throw Error::at(file, line, fmt::format("\"{}\" is no time in seconds", text));
  if (fraction.size() > kNanosecondDigits)
    throw Error::at(file, line, fmt::format("the time {} is finer than a nanosecond", text));
  fraction.resize(kNanosecondDigits, '0');
  std::int64_t s = 0, fraction_ns = 0;
  std::from_chars(whole.data(), whole.data() + whole.size(), s);
  std::from_chars(fraction.data(), fraction.data() + fraction.size(), fraction_ns);
  if (s > std::numeric_limits<std::int64_t>::max() / 1'000'000'000 - 1)
    throw Error::at(file, line, fmt::format("the time {} is too far away", text));
  return time_ns(s * 1'000'000'000 + fraction_ns);
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
    if (const auto fault = fault_of_time(read.captured, captured); !fault.empty()) rows.fail(fault);
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
