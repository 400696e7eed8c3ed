#pragma once

#include "eval/judgement/evaluation.h"
#include "eval/scores/scores.h"

namespace relock::naive {

// The evaluator a second time, written straight from docs/metrics.md: nothing but the plain data is shared
// with eval/, everything is found by looking over all frames again and again, and no speed was sought. It
// exists to disagree with eval/ when either is wrong.

Evaluation evaluate(const Recording& recording, const Trajectory& trajectory, const Gate& gate);
ScoreSheet score(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation);

}  // namespace relock::naive
