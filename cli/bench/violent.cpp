#include "cli/bench/violent.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "cli/print/targets.h"
#include "core/opencv.h"
#include "sequences/open.h"
#include "sequences/simulator/flight.h"

namespace relock::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kReadout_ms = 20;

/// A folder that is gone with this object.
class Temporary {
 public:
  Temporary() : path_(fs::temp_directory_path() / fmt::format("relock-bench-{}", getpid())) {
    fs::create_directories(path_);
  }
  ~Temporary() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Near the marker, so that it has some 100 px.
simulator::FlightPlan flight(const PrintedTarget& target, std::uint64_t seed) {
  simulator::FlightPlan plan = simulator::flight_preset("violent");
  plan.seed = seed;
  plan.duration_s = 1;
  plan.motion.distance_m = 0.5;
  plan.exposure.readout_ms = kReadout_ms;
  plan.targets = {{target.name, 0.15}};
  return plan;
}

/// The same size, tilt and length of blur, straight.
MadePicture still_like(const TargetTruth& truth, const PictureKind& of_target, const Bench& bench,
                       std::size_t rank) {
  simulator::StillPlan plan;
  plan.size_px = {truth.size_px(), truth.size_px()};
  plan.tilt_deg = {*truth.tilt_deg, *truth.tilt_deg};
  plan.blurs_px = {norm(*truth.blur)};
  return stills("beside violent flights", plan, of_target.targets, bench.settings().seeds).make(rank);
}

/// Of each frame whose marker is whole, whether it is recognised there and on a still like it.
struct Pairs {
  std::vector<bool> flown, still;

  void look(const Sequence& sequence, const PrintedTarget& target, Bench& bench) {
    const PictureKind kind{"", {target}, {}};
    const auto detector = bench.make_detector();
    const auto frames = sequence.frames();
    for (std::size_t frame = 0; frames->next(); ++frame) {
      const TargetTruth& truth = sequence.recording.truth_of(frame, 0);
      if (truth.label != Label::visible || truth.visible_fraction < 0.999 || !truth.blur || !truth.tilt_deg)
        continue;
      const MadePicture seen{read_only_mat(frames->image()), 0, truth};
      const MadePicture like = still_like(truth, kind, bench, flown.size());
      flown.push_back(judged(seen, kind, detector->detect(frames->image())).recognised);
      still.push_back(judged(like, kind, detector->detect(view(like.pixels))).recognised);
    }
  }
};

Measured difference(const Pairs& pairs) {
  Measured measured{"violent",
                    "violent flights, rolling shutter of 20 ms, over straight blur",
                    "points",
                    {},
                    {},
                    pairs.flown.size(),
                    {Goal::Sense::least, -3, -1}};
  if (pairs.flown.size() < 2) return measured;
  const auto n = static_cast<double>(pairs.flown.size());
  double sum = 0, squares = 0, flown = 0, still = 0;
  for (std::size_t i = 0; i < pairs.flown.size(); ++i) {
    const double d = 100.0 * (pairs.flown[i] - pairs.still[i]);
    sum += d, squares += d * d, flown += pairs.flown[i], still += pairs.still[i];
  }
  const double mean = sum / n, half = normal_quantile() * std::sqrt((squares / n - mean * mean) / (n - 1));
  measured.value = mean;
  measured.interval = Interval{mean - half, mean + half};
  measured.detail =
      fmt::format("{:.1f} % of the frames and {:.1f} % of the stills", 100 * flown / n, 100 * still / n);
  return measured;
}

}  // namespace

std::vector<Measured> measure_violent(Bench& bench) {
  const Temporary folder;
  const std::size_t flights = std::max<std::size_t>(1, bench.count(2 * 30, 40 * 30) / 30);
  Pairs pairs;
  for (std::size_t i = 0; i < flights; ++i) {
    const PrintedTarget& target = bench.targets()[i % bench.targets().size()];
    const std::uint64_t seed = 2 * i + (bench.settings().seeds == Seeds::odd ? 1 : 2);
    const fs::path flown = folder.path() / fmt::format("{}", seed);
    simulator::fly(flight(target, seed), print_target, flown, {.jobs = bench.settings().jobs});
    pairs.look(open_sequence(flown), target, bench);
  }
  return {difference(pairs)};
}

}  // namespace relock::bench
