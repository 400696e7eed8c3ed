#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "core/truth.h"

namespace relock {

/// What was recorded and what is true of it: all that the evaluator knows beside a method's answers, and more
/// than any method is told.
struct Recording {
  std::string name;
  Size picture;                    ///< px
  Duration period{};               ///< nominal period T (metrics.md section 2)
  std::vector<Time> captured;      ///< of every recorded frame, strictly increasing
  std::vector<Target> targets;     ///< ids are distinct
  std::vector<TargetTruth> truth;  ///< frame by frame, in each frame target by target

  std::size_t frames() const { return captured.size(); }
  const TargetTruth& truth_of(std::size_t frame, std::size_t target) const {
    return truth[frame * targets.size() + target];
  }
  TargetTruth& truth_of(std::size_t frame, std::size_t target) {
    return truth[frame * targets.size() + target];
  }
};

/// The recording as if it had ended after `frames` frames.
inline Recording up_to(Recording recording, std::size_t frames) {
  recording.captured.resize(frames);
  recording.truth.resize(frames * recording.targets.size());
  return recording;
}

}  // namespace relock
