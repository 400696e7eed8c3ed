#pragma once

#include <memory>
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
/// relock's own detector of the same rings.
const RingMethod& own_ring_method();
/// The detector of the paper as it comes, then the ways to read what the paper leaves open under which it behaves as
/// the paper says, then relock's own. All of them take part in figure 11 and table 1.
const std::vector<RingMethod>& ring_methods();
/// The four codes of two bits, as the paper orders them.
const std::vector<std::string>& ring_codes();
/// "ring:01"
std::string ring_target(const std::string& code);
/// A way to look for rings, and the ring of every code.
std::vector<Contender> contenders_of(const RingMethod& method);

/// Square markers that relock reads, every grid of cells once. Families that differ only in which codes they hold
/// (5x5_50 and 5x5_1000, 36h11 and 36h10) are found and blurred away alike; the customary one stands for all. Always
/// number 7: the lowest are plain in some families.
const std::vector<Contender>& square_markers();

/// What each of some contenders, or ways to look for rings, is looked for by.
template <class Asked>
std::vector<std::string> methods_of(const std::vector<Asked>& all) {
  std::vector<std::string> methods;
  for (const Asked& one : all) methods.push_back(one.method);
  return methods;
}

/// A detector that was asked for, its options checked.
struct ChosenDetector {
  const DetectorEntry* entry = nullptr;
  Options options;

  std::unique_ptr<Detector> make() const { return entry->make(options, 1); }
};
/// `method`: as it would be typed. Throws Error when there is none, and on its options.
ChosenDetector choose_detector(const Methods& methods, const std::string& method);

/// Whether relock has the detector.
bool is_built_in(const Methods& methods, const std::string& method);
/// Of `square_markers`, those whose detectors there are.
std::vector<Contender> squares_built_in(const Methods& methods);
/// One sentence for each detector that an experiment asks for and relock does not have.
std::vector<std::string> missing_methods(const Methods& methods, const std::vector<std::string>& asked);

}  // namespace relock::reproduction
