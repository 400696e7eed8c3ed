// `relock video`: truth and answers on the recording, methods side by side, at the recording's own times.

#include <fmt/format.h>

#include <algorithm>

#include "cli/chosen_methods.h"
#include "cli/chosen_target.h"
#include "cli/comparison.h"
#include "cli/interrupt.h"
#include "cli/readable.h"
#include "cli/recordings.h"
#include "cli/verbs.h"
#include "cli/video/film.h"
#include "core/error.h"
#include "sequences/open.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

/// The recording that runs were made from. Results hold no pictures.
Sequence open_pictures(const StoredComparison& stored, const VideoArguments& arguments) {
  const RunRecord& record = stored.runs.front().record;
  const fs::path path = recording_path(arguments.sequence.value_or(record.recording));
  if (!arguments.sequence && !fs::exists(path))
    throw Error(fmt::format("results hold no pictures; say where {} is: --sequence PATH", record.recording));
  Sequence sequence = open_sequence(path, {.labels = arguments.labels,
                                           .rate_hz = arguments.rate_hz,
                                           .format = arguments.format,
                                           .topic = arguments.topic});
  if (sequence.fingerprint != record.fingerprint)
    throw Error(fmt::format(
        "{} is not what {} was made from: its pictures, times or labels are others; give the same "
        "--sequence, --labels and --rate as `relock run` had",
        path.string(), stored.folder.string()));
  return sequence;
}

FilmPlan plan_of(const StoredComparison& stored, const VideoArguments& arguments) {
  const Recording& recording = stored.recording;
  const Time first = recording.captured.front();
  FilmPlan plan{
      chosen_runs(stored, arguments.methods, Yardsticks::if_alone), {}, first, recording.captured.back()};
  if (plan.runs.size() > kMostPanels)
    throw Error(fmt::format("a video shows {} methods at most, and these are {}; choose some with --method",
                            kMostPanels, plan.runs.size()));
  for (std::size_t t = 0; t < recording.targets.size(); ++t)
    if (wanted(recording.targets[t], arguments.target)) plan.targets.push_back(t);
  if (arguments.from_s) plan.from = first + from_seconds(*arguments.from_s);
  if (arguments.to_s) plan.to = first + from_seconds(*arguments.to_s);
  return plan;
}

/// Returns the exit status.
int make(std::vector<StoredComparison> all, const VideoArguments& arguments) {
  check_target(all, arguments.target);
  check_methods(all, arguments.methods);
  StoredComparison stored = only_one(std::move(all), "a video");
  const auto& anchor = stored.runs.front().record.anchor;
  if (anchor && anchor->direction == Direction::backward)
    throw Error("a video goes forward, and these runs go backward; choose runs that go forward");
  const Gate gate = gate_of(stored, arguments.gate);
  const Sequence sequence = open_pictures(stored, arguments);
  const ScoredComparison compared = scored(std::move(stored), gate);
  const Film film(compared, plan_of(compared.stored, arguments));
  if (film.shots().empty())
    throw Error(
        fmt::format("the recording has no frame from {:g} s to {:g} s; it lasts {:.2f} s",
                    arguments.from_s.value_or(0), arguments.to_s.value_or(0),
                    seconds(sequence.recording.captured.back() - sequence.recording.captured.front())));
  const auto frames = sequence.frames();
  if (!write_film(film, *frames, compared.stored.recording.period, arguments.out)) {
    fmt::print(stderr, "relock: interrupted; no video was written\n");
    return kInterrupted;
  }
  const Size size = film.size();
  fmt::print("{}: {} pictures of {}x{}, {:.2f} s\n", arguments.out.string(), film.shots().size(), size.width,
             size.height, seconds(film.shots().back().shown - film.shots().front().shown));
  return 0;
}

}  // namespace

int video(const VideoArguments& arguments) {
  if (arguments.out.extension() != ".mp4")
    throw Error(fmt::format("{} is no video's name; it ends in .mp4", arguments.out.string()));
  if (arguments.gate) parse_gate(*arguments.gate);
  int status = 0;
  const int unreadable =
      with_readable(find_results(arguments.folder),
                    [&](std::vector<StoredComparison> all) { status = make(std::move(all), arguments); });
  return std::max(status, unreadable);
}

}  // namespace relock
