#pragma once

#include <string>
#include <vector>

#include "cli/program.h"

namespace relock::reproduction {

/// A detector and the marker that it is asked to find.
struct Contender {
  std::string method;  ///< as it would be typed
  std::string target;  ///< as `relock marker` takes it
};

/// A way in which the rings are looked for.
struct RingMethod {
  std::string method;  ///< as it would be typed
  std::string note;    ///< what is special about it, for tables; empty: as it comes
  std::string reason;  ///< a sentence: why it is looked at beside the first one
};
/// The detector of the paper as it comes, and then the ways to read what the paper leaves open under which it behaves
/// as the paper says. All of them take part in figure 11 and table 1.
const std::vector<RingMethod>& ring_methods();
/// The four codes of two bits, as the paper orders them.
const std::vector<std::string>& ring_codes();
/// "ring:01"
std::string ring_target(const std::string& code);

/// Square markers that relock reads, every grid of cells once. Families that differ only in which codes they hold
/// (5x5_50 and 5x5_1000, 36h11 and 36h10) are found and blurred away alike; the customary one stands for all. Always
/// number 7: the lowest are plain in some families.
const std::vector<Contender>& square_markers();

/// Whether relock has the detector.
bool is_built_in(const Methods& methods, const std::string& method);
/// Of `square_markers`, those whose detectors there are.
std::vector<Contender> squares_built_in(const Methods& methods);
/// One sentence for each detector that an experiment asks for and relock does not have.
std::vector<std::string> missing_methods(const Methods& methods, const std::vector<std::string>& asked);

}  // namespace relock::reproduction
