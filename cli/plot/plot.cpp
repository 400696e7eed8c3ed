#include "cli/plot/plot.h"

#include "cli/plot/gnuplot.h"

namespace relock {

bool can_plot() { return figure::gnuplot_is_there(); }

}  // namespace relock
