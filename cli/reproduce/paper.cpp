#include "cli/reproduce/paper.h"

#include <algorithm>

namespace relock::reproduction::paper {
namespace {

constexpr double kFirst_px = 15, kLast_px = 65, kStep_px = 5;

PublishedRates steady(std::string_view name, double last_px) {
  PublishedRates published{name, {}};
  for (double blur = kFirst_px; blur <= last_px; blur += kStep_px) published.rates.push_back({blur, 100});
  return published;
}

/// What "undetectable after 50 pixels" and the omission from table 1 leave: found before 50 px, never from there on.
PublishedRates zeros() {
  PublishedRates published = steady("00", kZerosLeftOutFrom_px - kStep_px);
  for (double blur = kZerosLeftOutFrom_px; blur <= kLast_px; blur += kStep_px)
    published.rates.push_back({blur, 0});
  return published;
}

}  // namespace

std::optional<double> PublishedRates::at(double blur_px) const {
  const auto found = std::find_if(rates.begin(), rates.end(),
                                  [&](const RateAtBlur& rate) { return rate.blur_px == blur_px; });
  if (found == rates.end()) return {};
  return found->percent;
}

const PublishedRates& pitag() {
  static const PublishedRates published{"PiTag", {{15, 100}, {30, 0}, {35, 0}, {50, 0}}};
  return published;
}

const PublishedRates& artag() {
  static const PublishedRates published{"ARTag", {{15, 100}, {30, 100}, {35, 19}, {50, 0}}};
  return published;
}

const PublishedRates& ring(std::string_view code) {
  static const std::array<PublishedRates, 4> published{zeros(), steady("01", kLast_px),
                                                       steady("10", kLast_px), steady("11", kLast_px)};
  static const PublishedRates none{"", {}};
  const auto found =
      std::find_if(published.begin(), published.end(), [&](const auto& one) { return one.name == code; });
  return found == published.end() ? none : *found;
}

const std::array<CentreError, 5>& centre_errors() {
  static constexpr std::array<CentreError, 5> published{
      {{0, 1.33, 0.40}, {22, 2.42, 1.05}, {45, 1.46, 0.65}, {67, 2.39, 1.28}, {90, 1.83, 0.25}}};
  return published;
}

const std::array<RecordedTest, 4>& recorded_tests() {
  static constexpr std::array<RecordedTest, 4> published{{{1, 1205, "00", 65.6, 86.5},
                                                          {2, 1047, "01", 61.9, 94.1},
                                                          {3, 1102, "10", 62.4, 92.74},
                                                          {4, 1081, "11", 60.3, 93.54}}};
  return published;
}

}  // namespace relock::reproduction::paper
