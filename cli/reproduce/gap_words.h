#pragma once

#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/reproduce/gap_counts.h"
#include "cli/reproduce/gaps_or_blur.h"

// What the counts come to, in words and cells.

namespace relock::reproduction {

/// The counts of a method on the blurred flights of an arm.
std::vector<const GapCount*> blurred(const std::vector<GapCount>& counts, const std::string& method,
                                     GapArm arm);
std::vector<TrackingLifetime> lifetimes_of(const std::vector<GapCount>& counts, const std::string& method,
                                           GapArm arm);

/// What an effect's interval says of it.
enum class EffectVerdict : std::uint8_t { more, fewer, none_seen, unknown };
EffectVerdict verdict_on(const FlightMean& effect);

/// Each derived from the counts. The methods: of counts.reset and of counts.once, in the order in which they are told of.
std::vector<std::string> gap_sentences(const GapCounts& counts, const std::vector<std::string>& reset,
                                       const std::vector<std::string>& once);

/// "12.3 [10.1, 14.5]"
std::string mean_cell(const FlightMean& mean);
Json json_of(const FlightMean& mean);
Json json_of(const GapEffects& effects);

}  // namespace relock::reproduction
