#include "eval/scores/gain.h"

#include <algorithm>
#include <map>
#include <string>

#include "eval/scores/common_frames.h"

namespace relock {
namespace {

struct Arms {
  ArmSums without, with;
};
/// Of one sequence, for each member.
using SequenceSums = std::vector<Arms>;

/// Targets that every member was asked about in both arms.
std::vector<bool> asked_of_all(const Family& family) {
  std::vector<bool> counts(family.recording.targets.size(), true);
  for (const Pair& member : family.members)
    for (std::size_t t = 0; t < counts.size(); ++t)
      counts[t] =
          counts[t] && member.without.judged_from[t].has_value() && member.with.judged_from[t].has_value();
  return counts;
}

std::size_t frames_before_any_reset(const Family& family) {
  std::size_t frames = family.recording.frames();
  for (const Pair& member : family.members)
    frames = std::min(frames, frames_before_reset(member.without, member.with));
  return frames;
}

/// Of each frame, whether it was delivered in every arm.
std::vector<bool> delivered_to_all(const Family& family, std::size_t frames) {
  std::vector<bool> all(frames, true);
  const auto narrow = [&](const Trajectory& arm) {
    for (std::size_t frame = 0; frame < frames; ++frame)
      all[frame] = all[frame] && arm.frames[frame].delivery == Delivery::delivered;
  };
  for (const Pair& member : family.members) narrow(member.without), narrow(member.with);
  return all;
}

std::size_t count_losses(const Evaluation& evaluation, const std::vector<bool>& counts) {
  std::size_t losses = 0;
  for (std::size_t t = 0; t < counts.size(); ++t)
    if (counts[t]) losses += evaluation.targets[t].losses.size();
  return losses;
}

void add_family(const Family& family, const Gate& gate, SequenceSums& sums, FamilyGain& gain) {
  const std::vector<bool> counts = asked_of_all(family);
  const auto delivered = delivered_to_all(family, frames_before_any_reset(family));
  const Recording recording = up_to(family.recording, delivered.size());
  gain.targets += counts.size();
  gain.common_targets += static_cast<std::size_t>(std::count(counts.begin(), counts.end(), true));
  gain.frames += delivered.size();
  gain.common_frames += static_cast<std::size_t>(std::count(delivered.begin(), delivered.end(), true));
  sums.resize(family.members.size());
  for (std::size_t m = 0; m < family.members.size(); ++m) {
    const CommonFrames both = common_frames(recording, only(family.members[m].without, delivered),
                                            only(family.members[m].with, delivered));
    const Evaluation without = evaluate(both.recording, both.without, gate);
    const Evaluation with = evaluate(both.recording, both.with, gate);
    sums[m].without.add(both.recording, without, counts);
    sums[m].with.add(both.recording, with, counts);
    gain.members[m].losses_without += count_losses(without, counts);
    gain.members[m].losses_with += count_losses(with, counts);
  }
}

/// The score of one arm of a member, for each sequence.
std::vector<RatioSeries> series_of(const std::vector<SequenceSums>& sequences, std::size_t member,
                                   ArmSums Arms::*arm, CostScore score) {
  std::vector<RatioSeries> all;
  for (const SequenceSums& sums : sequences) all.push_back((sums[member].*arm)[score]);
  return all;
}

Gained gained(const std::vector<SequenceSums>& sequences, std::size_t member, ArmSums Arms::*arm,
              CostScore score) {
  const auto mine = series_of(sequences, member, arm, score), alone = series_of(sequences, 0, arm, score);
  Gained gained{value_of(mine), {}, {}};
  const auto before = value_of(alone);
  if (member == 0 || !gained.value || !before) return gained;
  gained.gain = *gained.value - *before;
  gained.interval = difference_interval(mine, alone);
  return gained;
}

}  // namespace

FamilyGain gain_of(std::span<const Family> families, const Gate& gate) {
  FamilyGain gain;
  if (families.empty()) return gain;
  gain.members.resize(families.front().members.size());
  std::map<std::string, SequenceSums> by_name;
  for (const Family& family : families) add_family(family, gate, by_name[family.recording.name], gain);
  std::vector<SequenceSums> sequences;
  for (auto& [name, sums] : by_name) sequences.push_back(std::move(sums));
  for (std::size_t m = 0; m < gain.members.size(); ++m)
    for (std::size_t s = 0; s < kRatioScores; ++s) {
      const auto score = static_cast<CostScore>(s);
      gain.members[m].without[s] = gained(sequences, m, &Arms::without, score);
      gain.members[m].with[s] = gained(sequences, m, &Arms::with, score);
    }
  return gain;
}

}  // namespace relock
