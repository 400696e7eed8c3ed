#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/json_text.h"
#include "core/geometry.h"

// How the page's data block writes what there is a lot of. cli/report/page/data.js reads it back.

namespace relock::reports {

/// RFC 4648, padded.
std::string base64(std::span<const std::uint8_t> bytes);

/// Numbers from 0 on in steps of kPackedStep, two bytes each, little-endian, as base64. What is not there is the
/// greatest; what is too large, the one below it.
std::string packed(const std::vector<std::optional<double>>& values);
constexpr double kPackedStep = 0.02;

/// Letters that stay the same for a while: "g1H23.2" for g, 23 times H, two times '.'.
std::string run_lengths(const std::string& letters);

/// A number with no more digits than it needs, for a smaller page.
Json rounded(double value, int decimals);
Json rounded(const std::optional<double>& value, int decimals);

/// ["b", x, y, width, height], ["q", x, y, … of four corners] or ["e", x, y, semi_major, semi_minor, angle_rad]; px.
Json outline_json(const Outline& outline);

}  // namespace relock::reports
