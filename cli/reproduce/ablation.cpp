#include "cli/reproduce/ablation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/reproduce/gap_flights.h"
#include "cli/reproduce/gap_words.h"

namespace relock::reproduction {
namespace {

const std::string kWhole = "blut";
constexpr std::uint64_t kSeeds = 5;

struct Ablated {
  std::string method, is;
};

const std::vector<Ablated>& ablated() {
  static const std::vector<Ablated> all{{kWhole, "as it comes"},
                                        {"blut(blur_templates=false)", "no blur templates, and so no lobes"},
                                        {"blut(blur_lobes=false)", "no lobes: blur does not lead the search"},
                                        {"blut(update=false)", "templates of the first look only"},
                                        {"blut(velocity=true)", "some particles at constant velocity"},
                                        {"blut(solver=fast)", "coefficients less exactly"},
                                        {"l1", "neither blur templates nor lobes"},
                                        {"ivt", "a subspace in the place of templates"}};
  return all;
}

/// Where it is flown.
struct Place {
  GapArm arm;
  bool blurred;
};
constexpr std::array<Place, 4> kPlaces{
    {{GapArm::all_frames, false}, {GapArm::all_frames, true}, {GapArm::gaps, false}, {GapArm::gaps, true}}};

const std::vector<double>& at(const LossRates& rates, const Place& place) {
  return rates[static_cast<std::size_t>(place.arm)][place.blurred ? 1 : 0];
}

/// What leaving it out adds, flight by flight.
FlightMean added(const LossRates& without, const LossRates& whole, const Place& place) {
  std::vector<double> differences;
  for (std::size_t flight = 0; flight < at(whole, place).size(); ++flight)
    differences.push_back(at(without, place).at(flight) - at(whole, place)[flight]);
  return mean_of(differences);
}

bool counted(const std::vector<GapCount>& counts, const std::string& method) {
  return std::ranges::find(counts, method, &GapCount::method) != counts.end();
}

template <class Cell>
Table table_of(const std::vector<GapCount>& counts, const std::string& about, bool with_whole,
               const Cell& cell) {
  std::vector<std::string> header{about, "is"};
  for (const Place& place : kPlaces)
    header.push_back(fmt::format("{}, {}", place.blurred ? "blurred" : "sharp", to_string(place.arm)));
  Table table(header);
  for (const auto& [method, is] : ablated()) {
    if (!counted(counts, method) || (method == kWhole && !with_whole)) continue;
    std::vector<std::string> row{method, is};
    for (const Place& place : kPlaces) row.push_back(mean_cell(cell(loss_rates(counts, method), place)));
    table.add(row);
  }
  return table;
}

std::string in_words(const std::vector<GapCount>& counts) {
  const LossRates whole = loss_rates(counts, kWhole);
  std::vector<std::string> needed;
  for (const auto& [method, is] : ablated()) {
    if (method == kWhole || !counted(counts, method)) continue;
    for (const Place& place : kPlaces)
      if (verdict_on(added(loss_rates(counts, method), whole, place)) == EffectVerdict::more) {
        needed.push_back(method);
        break;
      }
  }
  if (needed.empty()) return "On these flights no change to blut is seen to lose the target more often.";
  return fmt::format("Seen to lose the target more often than blut somewhere: {}.", fmt::join(needed, "; "));
}

Json figures_of(const std::vector<GapCount>& counts) {
  Json all = Json::array();
  const LossRates whole = loss_rates(counts, kWhole);
  for (const auto& [method, is] : ablated()) {
    if (!counted(counts, method)) continue;
    const LossRates rates = loss_rates(counts, method);
    for (const Place& place : kPlaces)
      all.push_back({{"method", method},
                     {"arm", to_string(place.arm)},
                     {"blurred", place.blurred},
                     {"losses_per_minute_held", json_of(mean_of(at(rates, place)))},
                     {"more_than_blut", json_of(added(rates, whole, place))}});
  }
  return {{"rows", all}};
}

}  // namespace

Finding finding_of_ablation(const std::vector<GapCount>& counts) {
  const LossRates whole = loss_rates(counts, kWhole);
  Finding finding;
  finding.id = "ablation";
  finding.title = "what each idea in blut is worth";
  finding.tables = {
      table_of(counts, "losses per minute held", true,
               [](const LossRates& rates, const Place& place) { return mean_of(at(rates, place)); }),
      table_of(counts, "more than blut, flight by flight", false,
               [&](const LossRates& rates, const Place& place) { return added(rates, whole, place); })};
  finding.sentences = {in_words(counts)};
  finding.figures = figures_of(counts);
  return finding;
}

std::vector<Finding> ablation(const Settings& settings, const Methods& methods) {
  if (settings.quick) return {};
  std::vector<GapFlight> flights = gap_flights(settings);
  std::erase_if(flights, [](const GapFlight& flight) { return flight.seed > kSeeds; });
  std::vector<std::string> wanted;
  for (const Ablated& one : ablated()) wanted.push_back(one.method);
  const auto cuts = fly_and_cut(settings, flights, {GapArm::all_frames, GapArm::gaps});
  return {finding_of_ablation(run_and_count(settings, cuts, wanted, Protocol::reset, methods))};
}

}  // namespace relock::reproduction
