#pragma once

#include "cli/runs/matrix.h"

namespace relock {

/// Makes the runs of a matrix that are not there yet, `jobs` at a time, and stores the truth of its sequences beside
/// them. Tells on stderr of an interrupt, of methods that failed and of recordings that are at fault. Returns the
/// exit status: 0; 1 when a method failed, which is scored as failed from there on; 2 when a run could not be made;
/// 130 after an interrupt. Whatever is complete is kept.
int make_missing_runs(const Matrix& matrix, int jobs);

}  // namespace relock
