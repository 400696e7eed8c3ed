#pragma once

#include <cstdint>
#include <string>

#include "cli/flights.h"
#include "cli/reproduce/paper.h"

// The flights of the paper's section 4.2, simulated. They are FROZEN: chosen to match what the paper says of its square
// markers and of its gaps, before the ring detector was run on them, so that what that one scores on them is a
// prediction (docs/reproducing-flights.md). To change anything here, or the simulator so that the same plans make
// other pictures, voids the prediction.

namespace relock::reproduction {

/// The flight of a test, "test-1" …: a ring with its code between two ArUco markers as large, on a wall; as many
/// frames as the paper's arrive.
NamedFlight test_flight(const paper::RecordedTest& test);

/// Section 4.2's box, a marker of 0.3 m on each side: with the rings 00, 01, 10, 11, "box-rings", and on the same way
/// with ArUco markers in their places, "box-squares".
NamedFlight box_of_rings();
NamedFlight box_of_squares();

/// The same flight with AprilTags in the places of its ArUco markers, "NAME-apriltag".
NamedFlight with_apriltags(NamedFlight flight);

/// The first `frames` frames that arrive of a flight, as "NAME-quick". Throws Error when there are fewer.
NamedFlight first_frames(NamedFlight flight, std::int64_t frames);

}  // namespace relock::reproduction
