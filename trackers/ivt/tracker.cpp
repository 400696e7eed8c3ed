#include "trackers/ivt/tracker.h"

#include <fmt/format.h>

#include <limits>

#include "trackers/ivt/subspace.h"
#include "trackers/particles/follower.h"

namespace relock {
namespace {

using particles::Observations, particles::State;

constexpr particles::ProposalOptions kRandomWalk{.blur_lobes = false, .velocity = false};

class IvtFollower final : public particles::ParticleFollower {
 public:
  IvtFollower(const IvtOptions& options, std::uint64_t seed)
      : ParticleFollower(options.particles, kRandomWalk, seed),
        options_(options),
        subspace_(options.components, options.forgetting),
        batch_(options.particles.grid.size(), options.batch) {}

 private:
  void learn_start(const particles::Sampling& sampling, const State& state) override {
    Eigen::MatrixXf first(options().grid.size(), 1);
    sampling.read(state, first.col(0));
    usable_ = particles::whiten(first.col(0));
    if (usable_) subspace_.learn(first);
  }

  void explain(const Observations& seen, std::vector<double>& unexplained) override {
    unexplained.assign(seen.usable.size(), std::numeric_limits<double>::infinity());
    if (!usable_) return;
    const Eigen::VectorXf distances = subspace_.squared_distances(seen.look);
    for (std::size_t i = 0; i < unexplained.size(); ++i)
      if (seen.usable[i]) unexplained[i] = distances[static_cast<Eigen::Index>(i)];
  }

  void learn(const Eigen::Ref<const Eigen::VectorXf>& look, bool) override {
    batch_.col(waiting_++) = look;
    if (waiting_ < batch_.cols()) return;
    subspace_.learn(batch_);
    waiting_ = 0;
  }

  IvtOptions options_;
  ivt::Subspace subspace_;
  Eigen::MatrixXf batch_;     // estimates that are not learnt yet,
  Eigen::Index waiting_ = 0;  // as many of them
  bool usable_ = false;       // the start box has contrast
};

}  // namespace

std::vector<OptionInfo> ivt_option_list() {
  const IvtOptions d;
  std::vector<OptionInfo> list = particles::particle_option_list();
  list.push_back({"components", fmt::format("{}", d.components), "",
                  "directions in which looks may vary; the published code's"});
  list.push_back({"forgetting", fmt::format("{}", d.forgetting), "",
                  "what was learnt counts that much less with each batch; the paper's, 1 forgets nothing"});
  list.push_back(
      {"batch", fmt::format("{}", d.batch), "frames", "estimates that are learnt at a time; the paper's"});
  return list;
}

IvtOptions ivt_options(const Options& given) {
  return {.particles = particles::particle_options(given),
          .components = given.whole("components", 1, 1000),
          .forgetting = given.number("forgetting", 0, 1),
          .batch = given.whole("batch", 1, 1000)};
}

std::unique_ptr<Tracker> ivt_tracker(const IvtOptions& options, std::uint64_t seed) {
  return checked_tracker("ivt", [&] { return std::make_unique<IvtFollower>(options, seed); });
}

}  // namespace relock
