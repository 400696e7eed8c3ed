#include "cli/reproduce/rates.h"

#include <fmt/format.h>

#include <map>

namespace relock::reproduction {

Interval Rate::interval() const {
  const Interval share = wilson(recognised, pictures);
  return {100 * share.low, 100 * share.high};
}

std::vector<Rate> rates_by_blur(const std::vector<PictureAnswer>& answers) {
  std::map<double, Rate> by_blur;
  for (const PictureAnswer& answer : answers) {
    Rate& rate = by_blur[answer.blur_px];
    rate.blur_px = answer.blur_px;
    ++rate.pictures;
    if (answer.recognised()) ++rate.recognised;
    if (answer.verdict == Verdict::WrongId) ++rate.wrong_code;
  }
  std::vector<Rate> rates;
  for (const auto& [blur, rate] : by_blur) rates.push_back(rate);
  return rates;
}

std::optional<Rate> rate_at(const std::vector<Rate>& rates, double blur_px) {
  for (const Rate& rate : rates)
    if (rate.blur_px == blur_px) return rate;
  return {};
}

std::string rate_text(const std::optional<Rate>& rate) {
  if (!rate) return "n/a";
  return fmt::format("{:.0f} [{:.0f}, {:.0f}]", rate->percent(), rate->interval().low, rate->interval().high);
}

PlotCurve curve_of(const std::string& name, const std::vector<Rate>& rates) {
  PlotCurve curve{.name = name, .points = {}};
  for (const Rate& rate : rates) curve.points.push_back({rate.blur_px, rate.percent(), rate.interval()});
  return curve;
}

PlotCurve curve_of(const std::string& name, const paper::PublishedRates& published) {
  PlotCurve curve{.name = name, .points = {}, .published = true};
  for (const paper::RateAtBlur& rate : published.rates) curve.points.push_back({rate.blur_px, rate.percent});
  return curve;
}

Json json_of(const std::vector<Rate>& rates) {
  Json all = Json::array();
  for (const Rate& rate : rates)
    all.push_back({{"blur_px", rate.blur_px},
                   {"pictures", rate.pictures},
                   {"recognised", rate.recognised},
                   {"wrong_code", rate.wrong_code},
                   {"percent", number(rate.percent())},
                   {"interval", interval(rate.interval())}});
  return all;
}

std::optional<std::string> departures(const std::string& name, const std::vector<Rate>& rates,
                                      const paper::PublishedRates& published) {
  std::string places;
  for (const Rate& rate : rates) {
    const auto printed = published.at(rate.blur_px);
    const Interval ours = rate.interval();
    if (!printed || (ours.low - 1e-9 <= *printed && *printed <= ours.high + 1e-9)) continue;
    places += fmt::format("{}{:g} px ({:.0f} % [{:.0f}, {:.0f}], printed {:g})", places.empty() ? "" : ", ",
                          rate.blur_px, rate.percent(), ours.low, ours.high, *printed);
  }
  if (places.empty()) return {};
  return fmt::format("{} departs from what is printed at {}.", name, places);
}

}  // namespace relock::reproduction
