#include "cli/reproduce/experiment.h"
#include "cli/reproduce/flight_experiments.h"
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
  };
  return all;
}

}  // namespace relock::reproduction
