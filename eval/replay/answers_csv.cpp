#include "eval/replay/answers_csv.h"

#include <fmt/format.h>

#include <istream>
#include <ostream>

#include "core/csv.h"
#include "core/error.h"

namespace relock {

void write_answers(std::ostream& out, const std::vector<Answer>& answers) {
  out << "frame,arrival_ns,finished_ns\n";
  for (const Answer& answer : answers)
    out << fmt::format("{},{},{}\n", answer.frame, ns(answer.arrived), ns(answer.finished));
}

std::vector<Answer> read_answers(std::istream& in, const std::string& file, const Recording& recording) {
  CsvReader rows(in, file);
  const auto frame = rows.column("frame"), arrival = rows.column("arrival_ns"),
             finished = rows.column("finished_ns");
  std::vector<Answer> all;
  while (rows.next()) {
    const Answer answer{rows.whole(frame), time_ns(rows.whole(arrival)), time_ns(rows.whole(finished))};
    if (answer.frame < 0 || answer.frame >= static_cast<FrameIndex>(recording.frames()))
      rows.fail(fmt::format("frame {} does not exist in {} (it has {} frames)", answer.frame, recording.name,
                            recording.frames()));
    if (!all.empty() && answer.frame <= all.back().frame)
      rows.fail(fmt::format("frame {} comes after frame {}", answer.frame, all.back().frame));
    const Time captured = recording.captured[static_cast<std::size_t>(answer.frame)];
    if (answer.arrived != captured)
      rows.fail(fmt::format("frame {} was captured at {} ns in {}; are these answers of another recording?",
                            answer.frame, ns(captured), recording.name));
    if (answer.finished < answer.arrived || (!all.empty() && answer.finished < all.back().finished))
      rows.fail(fmt::format("the answer to frame {} is there too early", answer.frame));
    all.push_back(answer);
  }
  return all;
}

Latency read_latencies(std::istream& in, const std::string& file) {
  CsvReader rows(in, file);
  const auto frame = rows.column("frame"), wall = rows.column("wall_ms");
  Latency latency;
  latency.kind = Latency::Kind::listed;
  latency.text = file;
  while (rows.next()) {
    const FrameIndex at = rows.whole(frame);
    const double ms = rows.number(wall);
    if (ms < 0 || ms > 3.6e6) rows.fail(fmt::format("{} ms is no latency; it must be from 0 to an hour", ms));
    if (!latency.listed.empty() && at <= latency.listed.back().first)
      rows.fail(fmt::format("frame {} comes after frame {}", at, latency.listed.back().first));
    latency.listed.emplace_back(at, from_seconds(1e-3 * ms));
  }
  if (latency.listed.empty()) throw Error(fmt::format("{} lists no latency", file));
  return latency;
}

}  // namespace relock
