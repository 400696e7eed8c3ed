#include "cli/bench/geometries.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "cli/table.h"

namespace relock::bench {
namespace {

constexpr std::array kBlurs_px{65.0, 100.0, 120.0, 150.0};

/// Four rings and the gaps between them all of one width u, about a hole of `hole` u; a negative one is a filled disc.
std::string equal_widths(double hole) {
  const double u = 1 / (std::abs(hole) + (hole < 0 ? 6 : 7));
  std::vector<std::string> slots;
  double from = hole < 0 ? 0 : hole * u;
  for (int slot = 0; slot < 4; ++slot) {
    const double width = slot == 0 && hole < 0 ? -hole * u : u;
    slots.push_back(slot == 3 ? fmt::format("{:.4f}-1", from)
                              : fmt::format("{:.4f}-{:.4f}", from, from + width));
    from += width + u;
  }
  return fmt::format("{}", fmt::join(slots, "/"));
}

Settings with_geometry(Settings settings, const TriedGeometry& tried) {
  settings.method.options["geometry"] = tried.geometry;
  settings.method.options["quiet_zone"] = fmt::format("{:g}", tried.quiet_zone);
  return settings;
}

GeometryRates rates_of(const TriedGeometry& tried, const Settings& settings, const Methods& methods) {
  Bench bench(with_geometry(settings, tried), methods);
  GeometryRates rates{tried, {}, {}, {}};
  const auto measure = [&](simulator::Backdrop backdrop, double blur) {
    const bool plain = backdrop == simulator::Backdrop::plain;
    simulator::StillPlan plan;
    plan.size_px = {150, 150}, plan.blurs_px = {blur}, plan.backdrop = backdrop;
    if (plain) plan.noise = {2, 2};
    // The same places and backdrops for every geometry.
    const PictureKind kind =
        stills(fmt::format("{} for geometries, blur {:g} px", plain ? "plain" : "clutter", blur), plan,
               bench.targets(), settings.seeds);
    const auto& looks = bench.looks(kind, bench.count(16, 200));
    (plain ? rates.plain : rates.clutter)
        .push_back(recognised("geometries", fmt::format("{}, {}", tried.name, kind.name), looks, {}));
    if (plain || blur != kBlurs_px.front()) return;
    std::vector<double> errors;
    for (const Look& look : looks)
      if (look.centre_px) errors.push_back(*look.centre_px);
    rates.centre = median("geometries", tried.name, "px", errors, {});
  };
  for (const double blur : kBlurs_px) measure(simulator::Backdrop::plain, blur);
  for (const double blur : kBlurs_px) measure(simulator::Backdrop::clutter, blur);
  return rates;
}

std::string rate_text(const Measured& rate) {
  return fmt::format("{:.0f} [{:.0f}, {:.0f}]", *rate.value, rate.interval->low, rate.interval->high);
}

}  // namespace

const std::vector<TriedGeometry>& tried_geometries() {
  static const std::vector<TriedGeometry> all{
      {"paper", "paper"},
      {"even: hole of 1 width", "even"},
      {"hole of 2 widths", equal_widths(2)},
      {"hole of 3 widths", equal_widths(3)},
      {"hole of 5 widths", equal_widths(5)},
      {"disc of 2 widths", equal_widths(-2)},
      {"paper, quiet zone 1.15 R", "paper", 1.15},
      {"paper, quiet zone 1.6 R", "paper", 1.6},
      {"even, quiet zone 1.6 R", "even", 1.6},
  };
  return all;
}

std::vector<GeometryRates> measure_geometries(const Settings& settings, const Methods& methods) {
  std::vector<GeometryRates> all;
  for (const TriedGeometry& tried : tried_geometries()) all.push_back(rates_of(tried, settings, methods));
  return all;
}

std::string text_of(const std::vector<GeometryRates>& all) {
  std::vector<std::string> header{"recognised, %, by blur, px"};
  for (const char* where : {"plain", "clutter"})
    for (const double blur : kBlurs_px) header.push_back(fmt::format("{} {:g}", where, blur));
  header.push_back("centre, px");
  Table table(header);
  for (const GeometryRates& rates : all) {
    std::vector<std::string> row{rates.tried.name};
    for (const auto* where : {&rates.plain, &rates.clutter})
      for (const Measured& rate : *where) row.push_back(rate_text(rate));
    row.push_back(cell(rates.centre.value, 3));
    table.add(row);
  }
  return fmt::format(
      "{}\n  D 150 px, tilt to 45 degrees, {} pictures a cell, the same places and backdrops for all; "
      "brackets "
      "are Wilson's 95 %. The centre is the median error at {:g} px in clutter.\n",
      table.text(2), all.front().plain.front().pictures, kBlurs_px.front());
}

Json json_of(const std::vector<GeometryRates>& all) {
  const auto to_json = [](const std::vector<Measured>& rates) {
    Json json = Json::array();
    for (std::size_t i = 0; i < rates.size(); ++i)
      json.push_back({{"blur_px", kBlurs_px[i]},
                      {"percent", number(rates[i].value)},
                      {"interval", interval(rates[i].interval)},
                      {"pictures", rates[i].pictures}});
    return json;
  };
  Json geometries = Json::array();
  for (const GeometryRates& rates : all)
    geometries.push_back({{"name", rates.tried.name},
                          {"geometry", rates.tried.geometry},
                          {"quiet_zone", rates.tried.quiet_zone},
                          {"plain", to_json(rates.plain)},
                          {"clutter", to_json(rates.clutter)},
                          {"centre_px", number(rates.centre.value)}});
  return geometries;
}

}  // namespace relock::bench
