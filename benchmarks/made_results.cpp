// Writes a folder of results as `relock run` would have left it: made recordings of one wandering target, and
// methods that lose it now and then. For scripts/bench: how scoring grows with the number of rows, what a report takes.
// Usage: made_results OUT SEQUENCES [FRAMES [METHODS]]      1000 frames and 5 methods if not given

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include "cli/runs/folder.h"
#include "cli/runs/truth.h"
#include "core/random.h"
#include "eval/trajectory_csv.h"

namespace {

using namespace relock;

Recording recording_of(std::size_t sequence, int frames) {
  Recording recording;
  Random random(sequence);
  recording.name = fmt::format("sequence-{:03}", sequence);
  recording.period = period_of(30);
  recording.picture = {640, 360};
  recording.targets = {{"target"}};
  for (int i = 0; i < frames; ++i) {
    recording.captured.push_back(Time{i * recording.period});
    TargetTruth truth;
    truth.label = Label::visible;
    truth.outline = Box{300 + 150 * std::sin(0.02 * i), 150 + 80 * std::sin(0.031 * i), 40, 40};
    truth.blur = Vec2{10 * random.uniform(), 10 * random.uniform()};
    recording.truth.push_back(truth);
  }
  return recording;
}

/// Hits, and outages of some 15 frames in which it is silent or stuck.
Trajectory trajectory_of(const Recording& recording, Random random) {
  Trajectory made;
  made.judged_from = {0};
  made.failed_from = {std::nullopt};
  int out = 0;
  bool silent = false;
  Box last;
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    FrameReport report;
    const Box box = std::get<Box>(*recording.truth[i].outline);
    if (i == 0) {
      report.given = {0};
      last = box;
    } else if (out > 0) {
      --out;
      if (!silent) report.sightings = {sighting_of(last)};
    } else {
      last = {box.x + random.normal(), box.y + random.normal(), box.width, box.height};
      report.sightings = {sighting_of(last)};
      if (random.chance(0.01)) out = 5 + static_cast<int>(random.below(20)), silent = random.chance(0.5);
    }
    for (Sighting& sighting : report.sightings) sighting = as_stored(sighting);
    made.frames.push_back(std::move(report));
  }
  return made;
}

FinishedRun run_of(const Recording& recording, int method, std::uint64_t seed) {
  const Trajectory trajectory = trajectory_of(recording, Random(seed));
  FinishedRun run;
  run.record.recording = recording.name;
  run.record.fingerprint = "made";
  run.record.method = fmt::format("method-{}", method);
  run.record.gaps = "none";
  run.record.judged_from = trajectory.judged_from;
  run.record.failed_from = trajectory.failed_from;
  std::ostringstream text;
  write_trajectory(text, recording, trajectory);
  run.trajectory = text.str();
  return run;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: made_results OUT SEQUENCES [FRAMES [METHODS]]\n");
    return 2;
  }
  const std::filesystem::path out = argv[1];
  const std::size_t sequences = std::stoul(argv[2]);
  const int frames = argc > 3 ? std::stoi(argv[3]) : 1000, methods = argc > 4 ? std::stoi(argv[4]) : 5;
  const ResultsLock lock = prepare_results(out);
  for (std::size_t s = 0; s < sequences; ++s) {
    const Recording recording = recording_of(s, frames);
    store_truth(out, recording, "made");
    for (int m = 0; m < methods; ++m) {
      const FinishedRun run =
          run_of(recording, m, static_cast<std::uint64_t>(methods) * s + static_cast<std::uint64_t>(m));
      store_run(run_folder(out, run.record), run);
    }
  }
}
