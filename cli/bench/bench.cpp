#include "cli/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/print/targets.h"
#include "cli/terminal.h"
#include "core/error.h"
#include "detectors/ring_marker.h"

namespace relock::bench {
namespace {

bool reaches(double value, double goal, Goal::Sense sense) {
  return sense == Goal::Sense::least ? value >= goal : value <= goal;
}

/// The rings that are read with these options.
std::vector<PrintedTarget> targets_of(const std::string& method, const Options& options) {
  const auto& values = options.values();
  if (!values.contains("bits") || !values.contains("geometry"))
    throw Error(fmt::format("{} has no options bits and geometry, so it is no detector of rings", method));
  const auto other = [&](const char* option) {  // that are as they come, unless they are there
    const auto value = values.find(option);
    return value == values.end() ? "" : fmt::format(",{}={}", option, value->second);
  };
  std::string geometry = values.at("geometry");
  std::replace(geometry.begin(), geometry.end(), ',', '/');
  std::vector<PrintedTarget> targets;
  for (const std::string& bits : all_ring_bits(options.whole("bits", 1, kMostRingBits)))
    targets.push_back(print_target(
        fmt::format("ring(geometry={}{}{}):{}", geometry, other("inverted"), other("quiet_zone"), bits),
        0.15));
  return targets;
}

}  // namespace

std::string verdict_of(const Measured& measured) {
  const Goal& goal = measured.goal;
  if (!measured.value) return "n/a";
  if (!goal.must && !goal.aim) return "reported";
  const auto good = [&](const std::optional<double>& level) {
    return level && reaches(*measured.value, *level, goal.sense);
  };
  // A "?" where the level that decided lies within the interval.
  const auto open = [&](const std::optional<double>& level) {
    const auto& interval = measured.interval;
    return level && interval && interval->low < *level && *level < interval->high ? "?" : "";
  };
  if (good(goal.aim) && measured.pictures >= goal.pictures_for_aim)
    return std::string("aim") + open(goal.aim);
  if (good(goal.must) && measured.pictures >= goal.pictures_for_must)
    return std::string("must") + open(goal.must);
  if (good(goal.must) || good(goal.aim)) return "too few";
  return std::string("missed") + open(goal.must ? goal.must : goal.aim);
}

Measured recognised(const std::string& row, const std::string& what, const std::vector<Look>& looks,
                    const Goal& goal) {
  Measured measured{row, what, "%", {}, {}, looks.size(), goal};
  if (looks.empty()) return measured;
  const auto found = static_cast<double>(
      std::count_if(looks.begin(), looks.end(), [](const Look& look) { return look.recognised; }));
  const auto all = static_cast<double>(looks.size());
  const Interval share = wilson(found, all);
  measured.value = 100 * found / all;
  measured.interval = Interval{100 * share.low, 100 * share.high};
  return measured;
}

Measured median(const std::string& row, const std::string& what, const std::string& unit,
                std::vector<double> values, const Goal& goal) {
  Measured measured{row, what, unit, {}, {}, values.size(), goal};
  if (values.empty()) return measured;
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const auto at = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::clamp(share * n, 0.0, n - 1));
    return values[rank];
  };
  measured.value = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
  const Interval share = wilson(n / 2, n);
  measured.interval = Interval{at(share.low), at(share.high)};
  return measured;
}

Bench::Bench(const Settings& settings, const Methods& methods)
    : settings_(settings),
      methods_(methods),
      entry_(&detector_entry(methods, settings.method.name)),
      options_(entry_->name, entry_->options, settings.method.options),
      targets_(targets_of(settings.method.text(), options_)) {}

std::size_t Bench::count(std::size_t sample, std::size_t full) const {
  return settings_.pictures.value_or(settings_.full ? full : sample);
}

const std::vector<Look>& Bench::looks(const PictureKind& kind, std::size_t count) {
  const auto there = looks_.find(kind.name);
  if (there != looks_.end() && there->second.size() == count) return there->second;
  Progress progress(kind.name, static_cast<std::int64_t>(count));
  std::int64_t done = 0;
  return looks_[kind.name] = look_at(
             kind, count, settings_.jobs, [&] { return make_detector(); }, [&] { progress.done(++done); });
}

std::unique_ptr<Detector> Bench::make_other(const std::string& name) const {
  const DetectorEntry& entry = detector_entry(methods_, name);
  return entry.make(Options(entry.name, entry.options, {}), 1);
}

}  // namespace relock::bench
