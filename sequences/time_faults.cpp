#include "sequences/time_faults.h"

#include <fstream>
#include <optional>

#include "core/csv.h"

namespace relock {

std::vector<TimeFault> time_faults(const std::filesystem::path& timestamps_csv) {
  std::ifstream in(timestamps_csv, std::ios::binary);
  if (!in || std::filesystem::is_directory(timestamps_csv)) return {};
  CsvReader rows(in, timestamps_csv.string());
  const auto column = rows.column("timestamp_ns");
  std::vector<TimeFault> faults;
  std::optional<Time> before;
  while (rows.next()) {
    const Time time = time_ns(rows.whole(column));
    if (before && time <= *before) faults.push_back({rows.line(), time, *before});
    before = time;
  }
  return faults;
}

}  // namespace relock
