#include "cli/report/encoded.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

extern "C" {
#include <libavutil/base64.h>
}

namespace relock::reports {

std::string base64(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return {};
  std::string text(AV_BASE64_SIZE(bytes.size()), '\0');
  av_base64_encode(text.data(), static_cast<int>(text.size()), bytes.data(), static_cast<int>(bytes.size()));
  text.resize(std::char_traits<char>::length(text.c_str()));
  return text;
}

std::string packed(const std::vector<std::optional<double>>& values) {
  constexpr double most = 65534;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const auto& value : values) {
    const bool known = value && std::isfinite(*value);
    const auto steps = static_cast<unsigned>(known ? std::lround(std::clamp(*value / kPackedStep, 0.0, most))
                                                   : std::lround(most) + 1);
    bytes.push_back(static_cast<std::uint8_t>(steps & 0xffU));
    bytes.push_back(static_cast<std::uint8_t>(steps >> 8U));
  }
  return base64(bytes);
}

std::string run_lengths(const std::string& letters) {
  std::string text;
  for (std::size_t i = 0; i < letters.size();) {
    const std::size_t end = std::min(letters.find_first_not_of(letters[i], i), letters.size());
    text += fmt::format("{}{}", letters[i], end - i);
    i = end;
  }
  return text;
}

Json rounded(double value, int decimals) {
  if (!std::isfinite(value)) return number(std::isnan(value) ? std::nullopt : std::optional(value));
  const double scale = std::pow(10., decimals), result = std::round(value * scale) / scale;
  if (result == std::round(result) && std::abs(result) < 1e15) return static_cast<std::int64_t>(result);
  return result;
}

Json rounded(const std::optional<double>& value, int decimals) {
  return value ? rounded(*value, decimals) : Json();
}

Json outline_json(const Outline& outline) {
  const auto px = [](double value) { return rounded(value, 1); };
  if (const auto* e = std::get_if<Ellipse>(&outline))
    return {"e",
            px(e->centre.x),
            px(e->centre.y),
            px(e->semi_major),
            px(e->semi_minor),
            rounded(e->angle_rad, 3)};
  if (const auto* b = std::get_if<Box>(&outline))
    return {"b", px(b->x), px(b->y), px(b->width), px(b->height)};
  Json quad{"q"};
  for (const Vec2& corner : std::get<Quad>(outline).corner) {
    quad.push_back(px(corner.x));
    quad.push_back(px(corner.y));
  }
  return quad;
}

}  // namespace relock::reports
