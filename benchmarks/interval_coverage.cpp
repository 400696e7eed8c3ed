// How often intervals of eval/statistics/ratio.h hold the truth, on simulated outages: what docs/statistics.md
// shows. Nominal is 95 %.

#include <fmt/format.h>

#include <algorithm>
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

/// What is not used: the percentiles of 1000 shares, each of stretches of the run put together, with lengths that are
/// geometric with mean `length` (stationary bootstrap, Politis and Romano 1994).
Interval percentiles_of_resamples(const std::vector<double>& good, double length, Random random) {
  const std::size_t frames = good.size();
  std::vector<double> sum{0};  // of the first so many frames, the run twice over
  for (std::size_t i = 0; i < 2 * frames; ++i) sum.push_back(sum.back() + good[i % frames]);
  std::vector<double> shares;
  for (int resample = 0; resample < 1000; ++resample) {
    double part = 0;
    for (std::size_t taken = 0; taken < frames;) {
      const std::size_t from = random.below(frames);
      const std::size_t stretch =
          std::min<std::size_t>(static_cast<std::size_t>(geometric(random, length)), frames - taken);
      part += sum[from + stretch] - sum[from];
      taken += stretch;
    }
    shares.push_back(part / static_cast<double>(frames));
  }
  std::sort(shares.begin(), shares.end());
  return {shares[25], shares[974]};
}

/// One run of 1000 frames by what was tried first.
void print_others(const Outages& outages, std::uint64_t repetitions) {
  constexpr double kLengths[] = {25, 50, 100, 200};
  Coverage wilson_of_frames, blocks[std::size(kLengths)];
  for (std::uint64_t seed = 0; seed < repetitions; ++seed) {
    Random random(seed);
    const std::vector<double> good = simulate_outages(random, 1000, outages);
    double hits = 0;
    for (const double one : good) hits += one;
    wilson_of_frames.add(wilson(hits, 1000), outages.truth());
    for (std::size_t i = 0; i < std::size(kLengths); ++i)
      blocks[i].add(percentiles_of_resamples(good, kLengths[i], random.fork(i)), outages.truth());
  }
  fmt::print("  {:3.0f} %  {:>2} to {}   {:5.1f} %", 100 * outages.rate, outages.shortest, outages.longest,
             wilson_of_frames.percent());
  for (const Coverage& c : blocks) fmt::print("  {:5.1f} %", c.percent());
  fmt::print("\n");
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
  fmt::print(
      "one run of 1000 frames by other means\n  out    lengths   Wilson   percentiles of resampled blocks "
      "of\n"
      "                             25       50       100      200 frames\n");
  for (const double rate : {0.05, 0.1, 0.2, 0.4})
    relock::print_others({rate, 5, 30, 0}, std::max<std::uint64_t>(1, repetitions / 2));
}
