#include "eval/judgement/loss_changes.h"

#include <algorithm>
#include <tuple>

namespace relock {
namespace {

struct Episode {
  Time from, to;
};

Episode episode(const Recording& recording, const Loss& loss) {
  const auto at = [&](FrameIndex frame) { return recording.captured[static_cast<std::size_t>(frame)]; };
  return {at(loss.last_good), std::max(at(loss.end_frame), at(loss.first_lost))};
}

Duration apart(const Episode& a, const Episode& b) {
  return a.from < b.from ? b.from - a.from : a.from - b.from;
}

bool may_be_one(const Episode& a, const Episode& b) {
  return (a.from < b.to && b.from < a.to) || apart(a, b) <= kSameEpisodeWithin;
}

LossChange in_both(const Recording& recording, const Loss& before, const Loss& after) {
  const Episode a = episode(recording, before), b = episode(recording, after);
  const bool same = before.last_good == after.last_good && before.first_lost == after.first_lost;
  return {same ? LossFate::kept : LossFate::moved, before, after, b.from - a.from,
          (b.to - b.from) - (a.to - a.from)};
}

/// Two losses that may be one, by their places in the lists.
struct Candidate {
  Duration apart;
  std::size_t before, after;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return std::tie(a.apart, a.before, a.after) < std::tie(b.apart, b.before, b.after);
  }
};

std::vector<Candidate> candidates(const Recording& recording, const std::vector<Loss>& before,
                                  const std::vector<Loss>& after) {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t j = 0; j < after.size(); ++j) {
      const Episode a = episode(recording, before[i]), b = episode(recording, after[j]);
      if (may_be_one(a, b)) all.push_back({apart(a, b), i, j});
    }
  std::sort(all.begin(), all.end());
  return all;
}

FrameIndex onset(const LossChange& change) {
  return (change.after ? *change.after : *change.before).last_good;
}

}  // namespace

std::string_view to_string(LossFate fate) {
  constexpr std::string_view names[] = {"kept", "moved", "gone", "new"};
  return names[static_cast<std::size_t>(fate)];
}

bool LossChange::differs() const {
  return before && after &&
         (longer != Duration{0} || before->kind != after->kind || before->end != after->end);
}

std::vector<LossChange> loss_changes(const Recording& recording, const std::vector<Loss>& before,
                                     const std::vector<Loss>& after) {
  std::vector<LossChange> changes;
  std::vector<bool> taken_before(before.size()), taken_after(after.size());
  for (const Candidate& pair : candidates(recording, before, after)) {
    if (taken_before[pair.before] || taken_after[pair.after]) continue;
    taken_before[pair.before] = taken_after[pair.after] = true;
    changes.push_back(in_both(recording, before[pair.before], after[pair.after]));
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!taken_before[i]) changes.push_back({LossFate::gone, before[i], {}});
  for (std::size_t j = 0; j < after.size(); ++j)
    if (!taken_after[j]) changes.push_back({LossFate::appeared, {}, after[j]});
  std::stable_sort(changes.begin(), changes.end(),
                   [](const LossChange& a, const LossChange& b) { return onset(a) < onset(b); });
  return changes;
}

}  // namespace relock
