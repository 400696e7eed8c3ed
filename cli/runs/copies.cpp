#include "cli/runs/copies.h"

#include <fmt/format.h>

#include <bit>

#include "core/error.h"

namespace relock {
namespace {

/// FNV-1a, of whole numbers.
class Hash {
 public:
  void add(std::uint64_t number) { value_ = (value_ ^ number) * 0x100000001b3u; }
  void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

std::uint64_t hash_of_answers(const StoredRun& run) {
  Hash hash;
  for (const FrameReport& frame : run.trajectory.frames) {
    hash.add(static_cast<std::uint64_t>(frame.delivery));
    for (const std::size_t target : frame.given) hash.add(std::uint64_t{target});
    hash.add(std::uint64_t{frame.sightings.size()});
    for (const Sighting& sighting : frame.sightings) {
      hash.add(sighting.centre.x);
      hash.add(sighting.centre.y);
      hash.add(size_of(sighting.outline));
    }
  }
  for (const Answer& answer : run.answers) hash.add(ns(answer.finished));
  return hash.value();
}

bool KnownRuns::first(const StoredRun& run, const Gate& judged_by) {
  const RunRecord& r = run.record;
  return known_
      .insert({r.recording, r.fingerprint, r.method, r.gaps, r.showing(), r.gate + to_string(judged_by),
               hash_of_answers(run)})
      .second;
}

void KnownRecordings::check(const StoredComparison& comparison) {
  const RunRecord& record = comparison.runs.front().record;
  const Known now{record.fingerprint, comparison.folder.string()};
  const auto [known, is_new] = known_.insert({comparison.recording.name, now});
  if (is_new || known->second.fingerprint == now.fingerprint) return;
  throw Error(
      fmt::format("{} is of another recording than {}, and both are called {}; score them apart, or give one "
                  "of them another name",
                  now.folder, known->second.folder, comparison.recording.name));
}

}  // namespace relock
