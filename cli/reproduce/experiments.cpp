#include "cli/reproduce/ablation.h"
#include "cli/reproduce/experiment.h"
#include "cli/reproduce/flight_experiments.h"
#include "cli/reproduce/gap_strips.h"
#include "cli/reproduce/gaps_or_blur.h"
#include "cli/reproduce/localization.h"
#include "cli/reproduce/pictures.h"
#include "cli/reproduce/recognition.h"

namespace relock::reproduction {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all{
      {"figure-3", "square markers on a blurred canvas", figure_3},
      {"figure-8", "a ring of each code in a simulated frame", figure_8},
      {"figure-9", "several rings in one simulated frame", figure_9},
      {"figure-10", "rings under blur of 50 px and more", figure_10},
      {"figure-11", "rings and square markers on the same canvas", figure_11},
      {"table-1", "error of a ring's centre on that canvas", table_1},
      {"table-2", "rings and square markers on four simulated flights", table_2},
      {"figure-12", "the same round a box", figure_12},
      {"figure-13", "a ring 00 as the blur-driven tracker loses it, beside its detector", figure_13},
      {"figure-14", "the same with a ring 01", figure_14},
      {"gaps-or-blur", "what trackers lose a ring at: the jump over a gap, its time, or blur", gaps_or_blur},
      {"ablation", "what each idea in the blur-driven tracker is worth", ablation},
  };
  return all;
}

}  // namespace relock::reproduction
