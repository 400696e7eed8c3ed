#pragma once

#include <string>
#include <vector>

#include "cli/reproduce/canvas_answers.h"
#include "cli/reproduce/contenders.h"
#include "cli/reproduce/experiment.h"
#include "core/printed_target.h"
#include "core/sighting.h"
#include "sequences/simulator/canvas.h"

namespace relock::reproduction {

/// Pictures that contenders are shown: the same ones, place for place and noise for noise.
struct CanvasExperiment {
  std::string name;  ///< of its folder
  simulator::CanvasPlan plan;
  std::uint64_t seed = 1;
};

/// What became of one contender.
struct CanvasResult {
  Contender contender;
  std::vector<PictureAnswer> answers;  ///< of all pictures, in their order
};

/// Shows the pictures to every contender whose answers are not in OUT/NAME/METHOD/TARGET.csv yet, and reads all of
/// them. A file is written whole, when its contender is done. Answers that were made with another plan, other
/// options or another version are made anew. The bytes are the same for any number of jobs.
std::vector<CanvasResult> run_canvas(const CanvasExperiment& experiment,
                                     const std::vector<Contender>& contenders, const Settings& settings,
                                     const Methods& methods);

/// The evaluator's verdict on what was seen in one picture of a canvas.
PictureAnswer judged(const PrintedTarget& target, const simulator::CanvasPicture& picture,
                     const Sightings& sightings);

/// The target of this name, of a size that does not matter on a canvas.
PrintedTarget target_on_canvas(const std::string& name);

}  // namespace relock::reproduction
