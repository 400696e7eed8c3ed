#include "cli/print/length.h"

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"

namespace relock {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};
constexpr Unit kUnits[] = {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}};

constexpr double kLeastM = 0.001, kMostM = 10;

}  // namespace

double parse_length_m(std::string_view text, std::string_view what) {
  double number = 0;
  const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view rest = text.substr(static_cast<std::size_t>(stop - text.data()));
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  for (const Unit& unit : kUnits) {
    if (fault != std::errc{} || rest != unit.name) continue;
    const double metres = number * unit.metres;
    if (!(metres >= kLeastM && metres <= kMostM))
      throw Error(fmt::format("{} is {}; it must be from 1mm to 10m", what, text));
    return metres;
  }
  throw Error(fmt::format("{} is \"{}\"; write a number and mm, cm, m or in, as in 150mm", what, text));
}

}  // namespace relock
