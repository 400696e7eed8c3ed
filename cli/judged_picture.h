#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/recording.h"
#include "core/sighting.h"
#include "eval/judgement/verdict.h"

// One picture by itself, judged as the evaluator judges frames.

namespace relock {

/// A recording of one frame.
Recording one_frame(const cv::Mat& pixels, const std::vector<Target>& targets,
                    const std::vector<TargetTruth>& truth);

/// The evaluator's verdicts on what was seen in a recording of one frame. Codes count when every target has one.
FrameJudgement judged_alone(const Recording& one_frame, const Sightings& sightings);

}  // namespace relock
