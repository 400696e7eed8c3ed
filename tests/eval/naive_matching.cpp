#include <algorithm>

#include "core/error.h"
#include "tests/eval/naive_scene.h"

namespace relock::naive {
namespace {

// --- Matching: which sighting each target takes, kNobody for none.

using Assignment = std::vector<int>;  // one for each target of the recording

// Most Hits, then most pairs, then least total e / D: the smaller tuple is the better one.
std::tuple<int, int, long long> badness(const Scene& scene, const Assignment& taken) {
  int hits = 0, pairs = 0;
  long long total = 0;
  for (std::size_t t = 0; t < taken.size(); ++t) {
    if (taken[t] == kNobody) continue;
    const auto s = static_cast<std::size_t>(taken[t]);
    hits += would_hit(scene, t, s) ? 1 : 0;
    pairs += 1;
    total += cost(scene, t, s);
  }
  return {-hits, -pairs, total};
}

// All one-to-one assignments, in the order in which they win a tie.
void list_assignments(const Scene& scene, const std::vector<std::size_t>& targets, std::size_t next,
                      const std::vector<std::size_t>& free, Assignment taken, std::vector<Assignment>& all) {
  if (next == targets.size()) {
    all.push_back(taken);
    return;
  }
  const std::size_t t = targets[next];
  for (const std::size_t s : by_place_for(scene, t, free)) {
    if (!may_be_matched(scene, t, s)) continue;
    auto rest = free;
    std::erase(rest, s);
    taken[t] = static_cast<int>(s);
    list_assignments(scene, targets, next + 1, rest, taken, all);
  }
  taken[t] = kNobody;
  list_assignments(scene, targets, next + 1, free, taken, all);
}

Assignment match(const Scene& scene, const std::vector<std::size_t>& targets,
                 const std::vector<std::size_t>& free) {
  std::vector<Assignment> all;
  list_assignments(scene, by_place(scene, targets), 0, free, Assignment(scene.targets(), kNobody), all);
  Assignment best = all.front();
  for (const Assignment& each : all)
    if (badness(scene, each) < badness(scene, best)) best = each;
  return best;
}

// --- Sightings left over.

// Of a known place, whatever the gate.
bool within_half_its_size(const Scene& scene, std::size_t t, std::size_t s) {
  return error_px(scene, t, s) <= 0.5 * outline_size(*scene.truth(t).outline);
}

bool may_be_one_not_judged(const Scene& scene, std::size_t s) {
  for (std::size_t t = 0; t < scene.targets(); ++t) {
    if (!judged_here(scene, t) && claims(scene, t, s)) return true;
    if (!scene.unlabelled(t)) continue;
    const bool place_known = scene.truth(t).outline.has_value();
    if (place_known && !tracked(scene, s) && within_half_its_size(scene, t, s)) return true;
    if (!place_known && claims_nobody(scene, s)) return true;
  }
  return false;
}

std::vector<std::size_t> where(std::size_t count, auto holds) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i)
    if (holds(i)) chosen.push_back(i);
  return chosen;
}

// The absent targets that a sighting claims: the one it tracks first, then in the order of the recording.
std::vector<std::size_t> absent_claimed(const Scene& scene, std::size_t s) {
  auto claimed =
      where(scene.targets(), [&](std::size_t t) { return scene.absent(t) && claims(scene, t, s); });
  std::stable_partition(claimed.begin(), claimed.end(), [&](std::size_t t) { return tracks(scene, t, s); });
  return claimed;
}

std::optional<std::size_t> own_visible_target(const Scene& scene, std::size_t s) {
  for (std::size_t t = 0; t < scene.targets(); ++t)
    if (tracks(scene, t, s) && scene.visible(t)) return t;
  return {};
}

std::optional<std::size_t> nearest_visible_target(const Scene& scene, std::size_t s) {
  std::optional<std::size_t> nearest;
  for (const std::size_t t :
       by_place(scene, where(scene.targets(), [&](std::size_t i) { return scene.visible(i); })))
    if (!nearest || error_px(scene, t, s) < error_px(scene, *nearest, s)) nearest = t;
  return nearest;
}

// Where each left-over sighting goes; `taken` has the matches and receives the Strays and False Alarms.
void place_left_overs(const Scene& scene, std::vector<std::size_t> left, Assignment& taken) {
  const auto is_free = [&](std::size_t t) { return judged_here(scene, t) && taken[t] == kNobody; };
  const auto take = [&](std::size_t t, std::size_t s) { taken[t] = static_cast<int>(s); };

  // A tracked one is its own visible target's Stray: the nearest, if there are several.
  for (std::size_t t = 0; t < scene.targets(); ++t) {
    auto own = left;
    std::erase_if(own, [&](std::size_t s) { return own_visible_target(scene, s) != t; });
    if (own.empty() || !is_free(t)) continue;
    take(t, *std::min_element(own.begin(), own.end(), [&](std::size_t a, std::size_t b) {
           return std::tuple(error_px(scene, t, a), a) < std::tuple(error_px(scene, t, b), b);
         }));
  }
  std::erase_if(left, [&](std::size_t s) { return own_visible_target(scene, s).has_value(); });

  // One that claims an absent target is its FalseAlarm.
  for (const std::size_t s : left)
    for (const std::size_t t : absent_claimed(scene, s))
      if (is_free(t)) {
        take(t, s);
        break;
      }
  std::erase_if(left, [&](std::size_t s) { return !absent_claimed(scene, s).empty() || tracked(scene, s); });

  // Another is a Stray of the nearest visible target if that is judged here and unmatched; nearest pair
  // first.
  struct Pair {
    double px;
    std::tuple<double, double, std::size_t> target, sighting;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  for (const std::size_t s : left)
    if (const auto t = nearest_visible_target(scene, s))
      pairs.push_back({error_px(scene, *t, s), target_place(scene, *t), sighting_place(scene, s)});
  std::sort(pairs.begin(), pairs.end());
  for (const Pair& pair : pairs)
    if (is_free(std::get<2>(pair.target))) take(std::get<2>(pair.target), std::get<2>(pair.sighting));
}

// The first of the table that applies.
Verdict verdict_of(const Scene& scene, std::size_t t, int sighting) {
  const auto delivery = scene.trajectory.frames[scene.frame].delivery;
  if (not_started(scene, t)) return Verdict::NotStarted;
  if (delivery == Delivery::dropped) return Verdict::Dropped;
  if (delivery == Delivery::skipped) return Verdict::Skipped;
  if (given(scene, t)) return Verdict::Given;
  if (scene.unlabelled(t)) return Verdict::Unlabelled;
  if (scene.absent(t)) return sighting == kNobody ? Verdict::CorrectReject : Verdict::FalseAlarm;
  if (sighting == kNobody) return Verdict::Miss;
  const auto s = static_cast<std::size_t>(sighting);
  if (would_hit(scene, t, s)) return Verdict::Hit;
  if (within_hold(scene, t, s) && wrong_code(scene, t, s)) return Verdict::WrongId;
  return Verdict::Stray;
}

Judgement judgement_of(const Scene& scene, std::size_t t, int sighting) {
  Judgement judgement;
  judgement.verdict = verdict_of(scene, t, sighting);
  const auto failed_from = scene.trajectory.failed_from[t];
  judgement.failed = judgement.verdict == Verdict::Miss && failed_from &&
                     *failed_from <= static_cast<FrameIndex>(scene.frame);
  if (sighting == kNobody) return judgement;
  const auto s = static_cast<std::size_t>(sighting);
  judgement.sighting = sighting;
  if (!scene.visible(t)) return judgement;
  judgement.error_px = error_px(scene, t, s);
  judgement.hold = within_hold(scene, t, s) && !wrong_code(scene, t, s);
  judgement.uncoded = judgement.verdict == Verdict::Hit && scene.trajectory.reads_codes &&
                      scene.target(t).code.has_value() && !scene.sightings[s].code.has_value();
  return judgement;
}

}  // namespace

bool is_scored(Verdict v) {
  return v == Verdict::Hit || v == Verdict::WrongId || v == Verdict::Stray || v == Verdict::Miss;
}

FrameJudgement judge(const Recording& recording, std::size_t frame, const Trajectory& trajectory,
                     const Gate& gate) {
  const FrameReport& report = trajectory.frames[frame];
  const Scene scene{recording, trajectory, gate, frame, report.sightings};
  if (report.delivery != Delivery::delivered && !report.sightings.empty())
    throw Error("a frame that was not delivered has sightings");

  Assignment taken(scene.targets(), kNobody);
  FrameJudgement result;
  const auto left_out_targets =
      where(scene.targets(), [&](std::size_t t) { return given_or_not_started(scene, t); });
  if (left_out_targets.size() == scene.targets()) {
    result.ignored = static_cast<int>(scene.sightings.size());  // the frame is left out whole
  } else {
    auto left = where(scene.sightings.size(), [](std::size_t) { return true; });
    const auto judged =
        where(scene.targets(), [&](std::size_t t) { return scene.visible(t) && judged_here(scene, t); });
    const auto last =
        where(scene.targets(), [&](std::size_t t) { return scene.visible(t) && !judged_here(scene, t); });
    taken = match(scene, judged, left);
    std::erase_if(
        left, [&](std::size_t s) { return std::count(taken.begin(), taken.end(), static_cast<int>(s)) > 0; });
    const Assignment taken_last = match(scene, last, left);
    const auto is_ignored = [&](std::size_t s) {
      return std::count(taken_last.begin(), taken_last.end(), static_cast<int>(s)) > 0 ||
             may_be_one_not_judged(scene, s);
    };
    result.ignored = static_cast<int>(std::erase_if(left, is_ignored));
    place_left_overs(scene, left, taken);
    for (const std::size_t s : left)
      if (std::count(taken.begin(), taken.end(), static_cast<int>(s)) == 0) ++result.spurious;
  }
  for (std::size_t t = 0; t < scene.targets(); ++t)
    result.targets.push_back(judgement_of(scene, t, taken[t]));
  return result;
}

}  // namespace relock::naive
