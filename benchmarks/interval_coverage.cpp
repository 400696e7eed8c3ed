// How often intervals of eval/statistics/ratio.h hold the truth, on simulated outages: what docs/statistics.md
// shows. Nominal is 95 %.

#include <fmt/format.h>

#include <cstdlib>

#include "tests/eval/statistics/outages.h"

namespace relock {
namespace {

struct Setting {
  std::size_t runs, frames;
  Outages outages;
};

std::vector<RatioSeries> draw(Random& random, const Setting& setting) {
  std::vector<RatioSeries> sequences;
  for (std::size_t run = 0; run < setting.runs; ++run)
    sequences.push_back(share_of_frames(simulate_outages(random, setting.frames, setting.outages)));
  return sequences;
}

/// Both fail together where `shared` does, and each on its own.
std::vector<RatioSeries> both(const std::vector<RatioSeries>& shared, const std::vector<RatioSeries>& own) {
  std::vector<RatioSeries> product = shared;
  for (std::size_t s = 0; s < shared.size(); ++s)
    for (std::size_t i = 0; i < shared[s].part.size(); ++i) product[s].part[i] *= own[s].part[i];
  return product;
}

void print_row(const Setting& setting, std::uint64_t repetitions) {
  Coverage share, difference;
  for (std::uint64_t seed = 0; seed < repetitions; ++seed) {
    Random random(seed);
    const auto shared = draw(random, setting);
    share.add(ratio_interval(shared), setting.outages.truth());
    const auto a = both(shared, draw(random, setting)), b = both(shared, draw(random, setting));
    difference.add(difference_interval(a, b), 0);
  }
  const auto told = [&](const Coverage& c) {
    if (c.told < repetitions / 10) return std::string("      -             ");
    return fmt::format("{:5.1f} % of {:4.0f} % told", c.percent(),
                       100 * static_cast<double>(c.told) / static_cast<double>(c.asked));
  };
  const Outages& o = setting.outages;
  const std::string lengths =
      o.longest > 0 ? fmt::format("{} to {}", o.shortest, o.longest) : fmt::format("mean {}", o.shortest);
  fmt::print("{:4} x {:4}  {:3.0f} %  {:>8}  {:7.1f}   {}   {}\n", setting.runs, setting.frames, 100 * o.rate,
             lengths, static_cast<double>(setting.runs * setting.frames) * o.rate / o.mean_length(),
             told(share), told(difference));
}

}  // namespace
}  // namespace relock

// Usage: interval_coverage [REPETITIONS]
int main(int argc, char** argv) {
  const std::uint64_t repetitions = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
  fmt::print(
      "{} repetitions\n  runs of    out   lengths  outages   share                  paired difference\n",
      repetitions);
  for (const auto& [runs, frames] : {std::pair{1u, 300u}, {1u, 1000u}, {1u, 5000u}, {3u, 1000u}, {12u, 300u}})
    for (const double rate : {0.02, 0.05, 0.1, 0.2, 0.4})
      for (const auto& [shortest, longest] : {std::pair{5, 0}, {5, 30}, {30, 0}})
        relock::print_row({runs, frames, {rate, shortest, longest, 0}}, repetitions);
}
