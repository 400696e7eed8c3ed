#include "cli/jump/jumps.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "eval/replay/protocol.h"

namespace relock::jumps {
namespace {

bool visible(const Recording& recording, std::size_t frame, std::size_t target) {
  return recording.truth_of(frame, target).label == Label::visible;
}

/// How far the target goes between two frames, in its size on the first.
double distance(const Recording& recording, std::size_t from, std::size_t to, std::size_t target) {
  const TargetTruth& before = recording.truth_of(from, target);
  return norm(centre_of(*recording.truth_of(to, target).outline) - centre_of(*before.outline)) /
         before.size_px();
}

std::optional<Jump> jump_over(const Recording& recording, std::size_t start, std::size_t target, int missing,
                              const JumpTest& test) {
  const std::size_t held = start + static_cast<std::size_t>(test.before),
                    first = held + 1 + static_cast<std::size_t>(missing),
                    last = first + static_cast<std::size_t>(test.after) - 1;
  if (last >= recording.frames() || !visible(recording, held, target)) return {};
  for (std::size_t frame = first; frame <= last; ++frame)
    if (!visible(recording, frame, target)) return {};
  Jump jump{target, static_cast<FrameIndex>(start), missing, distance(recording, held, first, target), 0};
  const auto edge = std::upper_bound(test.edges.begin(), test.edges.end(), jump.distance);
  if (edge == test.edges.begin() || edge == test.edges.end()) return {};
  jump.bin = static_cast<std::size_t>(edge - test.edges.begin()) - 1;
  return jump;
}

double off_middle(const Jump& jump, const JumpTest& test) {
  return std::abs(jump.distance - 0.5 * (test.edges[jump.bin] + test.edges[jump.bin + 1]));
}

}  // namespace

std::vector<Jump> jumps_in(const Recording& recording, const JumpTest& test) {
  std::vector<Jump> all;
  const auto window = static_cast<std::size_t>(test.window());
  for (std::size_t start = 0; start + window <= recording.frames(); start += window)
    for (std::size_t target = 0; target < recording.targets.size(); ++target) {
      if (!startable(recording, start, target)) continue;
      std::vector<std::optional<Jump>> best(test.bins());
      for (int missing = 0; missing <= test.most_missing; ++missing) {
        const auto jump = jump_over(recording, start, target, missing, test);
        if (!jump) continue;
        std::optional<Jump>& other = best[jump->bin];
        if (!other || off_middle(*jump, test) < off_middle(*other, test)) other = jump;
      }
      for (const auto& jump : best)
        if (jump) all.push_back(*jump);
    }
  return all;
}

Scene scene_of(const Recording& recording, const Jump& jump, const JumpTest& test, Clock clock) {
  Scene scene;
  const auto start = static_cast<std::size_t>(jump.start), before = static_cast<std::size_t>(test.before),
             missing = static_cast<std::size_t>(jump.missing);
  scene.held = before;
  for (std::size_t rank = 0; rank <= before + missing + static_cast<std::size_t>(test.after); ++rank) {
    const bool shown = rank <= before || rank > before + missing;
    if (!shown && clock == Clock::closed) continue;
    if (!shown) scene.missing.push_back(scene.frames.size());
    scene.frames.push_back(start + rank);
  }
  scene.judged = scene.frames.size() - 1;

  Recording& part = scene.recording;
  part.name = recording.name, part.picture = recording.picture, part.period = recording.period;
  part.targets = {recording.targets[jump.target]};
  const Duration over_the_gap =
      recording.captured[start + before + missing + 1] - recording.captured[start + before];
  for (const std::size_t frame : scene.frames) {
    const bool moved = clock == Clock::closed && frame > start + before;
    part.captured.push_back(recording.captured[frame] -
                            (moved ? over_the_gap - recording.period : Duration{}));
    part.truth.push_back(recording.truth_of(frame, jump.target));
  }
  return scene;
}

}  // namespace relock::jumps
