#include "cli/judged_picture.h"

#include <algorithm>

namespace relock {

Recording one_frame(const cv::Mat& pixels, const std::vector<Target>& targets,
                    const std::vector<TargetTruth>& truth) {
  Recording recording;
  recording.picture = {pixels.cols, pixels.rows};
  recording.period = period_of(30);
  recording.captured = {Time{}};
  recording.targets = targets;
  recording.truth = truth;
  return recording;
}

FrameJudgement judged_alone(const Recording& one_frame, const Sightings& sightings) {
  Trajectory trajectory;
  trajectory.reads_codes = std::all_of(one_frame.targets.begin(), one_frame.targets.end(),
                                       [](const Target& target) { return target.code.has_value(); });
  trajectory.frames = {{.sightings = sightings}};
  trajectory.judged_from.assign(one_frame.targets.size(), 0);
  trajectory.failed_from.assign(one_frame.targets.size(), std::nullopt);
  return judge_frame(one_frame, 0, trajectory.frames.front(), trajectory, Gate{});
}

}  // namespace relock
