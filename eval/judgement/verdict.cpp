#include "eval/judgement/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/error.h"
#include "eval/judgement/matching.h"

namespace relock {
namespace {

struct VerdictName {
  std::string_view name;
  char letter;
};
constexpr std::array<VerdictName, kVerdicts> kNames{{{"NotStarted", ' '},
                                                     {"Dropped", '.'},
                                                     {"Skipped", '-'},
                                                     {"Given", 'g'},
                                                     {"Unlabelled", '?'},
                                                     {"Hit", 'H'},
                                                     {"WrongId", 'W'},
                                                     {"Stray", 'S'},
                                                     {"Miss", 'M'},
                                                     {"FalseAlarm", 'F'},
                                                     {"CorrectReject", 'r'}}};

/// How near a sighting is to a target's truth.
struct Nearness {
  double error_px = 0;
  bool hit = false;   ///< within the hit gate
  bool hold = false;  ///< within the hold gate
  std::int64_t distance = 0;
};

Nearness nearness(const Sighting& sighting, const TargetTruth& truth, const Gate& gate) {
  Nearness n;
  n.error_px = norm(sighting.centre - truth.centre(sighting.centre_kind));
  if (gate.measure == Gate::Measure::centre) {
    const double size = truth.size_px();
    n.hit = n.error_px <= gate.hit * size;
    n.hold = n.error_px <= gate.hold * size;
    // Farther pairs are no candidates, and their distance might not fit.
    n.distance = n.hold ? std::llround(n.error_px / size * 1e9) : 0;
  } else {
    const double overlap = intersection_over_union(bounds(sighting.outline), bounds(*truth.outline));
    n.hit = overlap >= gate.hit;
    n.hold = overlap >= gate.hold;
    n.distance = std::llround((1 - overlap) * 1e9);
  }
  return n;
}

bool wrong_code(const Sighting& sighting, const Target& target) {
  return sighting.code && target.code && *sighting.code != *target.code;
}

bool tracks(const Sighting& sighting, const Target& target) { return sighting.track == target.id; }

bool claims(const Sighting& sighting, const Target& target) {
  return tracks(sighting, target) || (sighting.code && sighting.code == target.code);
}

/// One frame's sightings and targets on their way to being judged. Every step takes sightings out of `left_`.
class FrameJudge {
 public:
  FrameJudge(const Recording& recording, std::size_t frame, const FrameReport& report,
             const Trajectory& trajectory, const Gate& gate)
      : recording_(recording), frame_(frame), report_(report), trajectory_(trajectory), gate_(gate) {}

  FrameJudgement judge() {
    result_.targets.resize(targets());
    left_.resize(report_.sightings.size());
    std::iota(left_.begin(), left_.end(), std::size_t{0});
    settle_what_needs_no_look();
    if (report_.delivery != Delivery::delivered) return result_;
    if (nothing_is_judged()) return ignore_everything();
    match_targets(/*round=*/&FrameJudge::open);
    match_targets(/*round=*/&FrameJudge::not_judged_but_visible);
    ignore_what_may_be_unjudged();
    give_tracked_strays();
    give_false_alarms();
    give_nearest_strays();
    result_.spurious = static_cast<int>(left_.size());
    settle_the_silent();
    return result_;
  }

 private:
  std::size_t targets() const { return recording_.targets.size(); }
  const TargetTruth& truth(std::size_t t) const { return recording_.truth_of(frame_, t); }
  const Target& target(std::size_t t) const { return recording_.targets[t]; }
  const Sighting& sighting(std::size_t s) const { return report_.sightings[s]; }
  Judgement& on(std::size_t t) { return result_.targets[t]; }
  bool visible(std::size_t t) const { return truth(t).label == Label::visible; }

  /// Visible, judged here, and nothing said of it yet (NotStarted marks it so until settled).
  bool open(std::size_t t) const { return visible(t) && judged_[t] && !settled_[t]; }
  bool not_judged_but_visible(std::size_t t) const { return visible(t) && !judged_[t]; }

  void settle(std::size_t t, Verdict verdict) {
    on(t).verdict = verdict;
    settled_[t] = true;
  }

  void settle_what_needs_no_look() {
    judged_.assign(targets(), false);
    settled_.assign(targets(), false);
    for (std::size_t t = 0; t < targets(); ++t) {
      const auto& from = trajectory_.judged_from[t];
      if (!from || static_cast<FrameIndex>(frame_) < *from) {
        settle(t, Verdict::NotStarted);
      } else if (report_.delivery == Delivery::dropped) {
        settle(t, Verdict::Dropped);
      } else if (report_.delivery == Delivery::skipped) {
        settle(t, Verdict::Skipped);
      } else if (std::binary_search(report_.given.begin(), report_.given.end(), t)) {
        settle(t, Verdict::Given);
      } else if (std::binary_search(report_.withheld.begin(), report_.withheld.end(), t)) {
        settle(t, Verdict::NotStarted);
      } else if (truth(t).label == Label::unlabelled) {
        settle(t, Verdict::Unlabelled);
      } else {
        judged_[t] = true;
      }
    }
  }

  bool nothing_is_judged() const {
    return std::all_of(result_.targets.begin(), result_.targets.end(), [&](const Judgement& j) {
      const auto t = static_cast<std::size_t>(&j - result_.targets.data());
      return !judged_[t] && j.verdict != Verdict::Unlabelled;
    });
  }

  FrameJudgement ignore_everything() {
    result_.ignored = static_cast<int>(left_.size());
    return result_;
  }

  /// Targets in order of (x, y): never by name.
  std::vector<std::size_t> in_order_of_place(bool (FrameJudge::*round)(std::size_t) const) const {
    std::vector<std::size_t> order;
    for (std::size_t t = 0; t < targets(); ++t)
      if ((this->*round)(t)) order.push_back(t);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const Vec2 p = centre_of(*truth(a).outline), q = centre_of(*truth(b).outline);
      return std::tie(p.x, p.y) < std::tie(q.x, q.y);
    });
    return order;
  }

  std::vector<Candidate> candidates(const std::vector<std::size_t>& order) const {
    std::vector<Candidate> all;
    for (const std::size_t t : order) {
      std::vector<std::size_t> near;
      for (const std::size_t s : left_) {
        if (sighting(s).track && !tracks(sighting(s), target(t))) continue;
        if (nearness(sighting(s), truth(t), gate_).hold) near.push_back(s);
      }
      std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
        const auto key = [&](std::size_t s) {
          return std::tuple(sighting(s).centre.x, sighting(s).centre.y, wrong_code(sighting(s), target(t)));
        };
        return key(a) < key(b);
      });
      for (const std::size_t s : near) {
        const Nearness n = nearness(sighting(s), truth(t), gate_);
        const bool hit = n.hit && !wrong_code(sighting(s), target(t));
        all.push_back({static_cast<int>(t), static_cast<int>(s), hit, n.distance});
      }
    }
    return all;
  }

  void match_targets(bool (FrameJudge::*round)(std::size_t) const) {
    if (left_.empty()) return;
    const auto order = in_order_of_place(round);
    if (order.empty()) return;
    const auto all = candidates(order);
    const auto paired = match(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!paired[i]) continue;
      const auto t = static_cast<std::size_t>(all[i].target), s = static_cast<std::size_t>(all[i].sighting);
      if (judged_[t]) {
        judge_pair(t, s, all[i].hit);
      } else {
        ++result_.ignored;
      }
      take(s);
    }
  }

  void judge_pair(std::size_t t, std::size_t s, bool hit) {
    const bool wrong = wrong_code(sighting(s), target(t));
    rest_on(t, s, hit ? Verdict::Hit : wrong ? Verdict::WrongId : Verdict::Stray);
    on(t).hold = !wrong;
    on(t).uncoded = hit && trajectory_.reads_codes && target(t).code && !sighting(s).code;
  }

  void rest_on(std::size_t t, std::size_t s, Verdict verdict) {
    settle(t, verdict);
    on(t).sighting = static_cast<int>(s);
    if (visible(t)) on(t).error_px = norm(sighting(s).centre - truth(t).centre(sighting(s).centre_kind));
  }

  void take(std::size_t s) { left_.erase(std::find(left_.begin(), left_.end(), s)); }

  /// Sightings left over that may be of a target that is not judged here.
  void ignore_what_may_be_unjudged() {
    const auto erased = std::erase_if(left_, [&](std::size_t s) { return may_be_unjudged(sighting(s)); });
    result_.ignored += static_cast<int>(erased);
  }

  bool may_be_unjudged(const Sighting& seen) const {
    bool place_unknown = false, claims_somebody = false;
    for (std::size_t t = 0; t < targets(); ++t) {
      const bool claimed = claims(seen, target(t));
      claims_somebody |= claimed;
      if (judged_[t]) continue;
      if (claimed) return true;
      if (truth(t).label != Label::unlabelled) continue;
      if (!truth(t).outline) {
        place_unknown = true;
      } else if (!seen.track && within_hold(seen, truth(t))) {
        return true;
      }
    }
    return place_unknown && !claims_somebody;
  }

  bool within_hold(const Sighting& seen, const TargetTruth& place) const {
    return norm(seen.centre - place.centre(seen.centre_kind)) <= Gate{}.hold * place.size_px();
  }

  double distance_px(std::size_t s, std::size_t t) const {
    return norm(sighting(s).centre - truth(t).centre(sighting(s).centre_kind));
  }

  /// A tracked sighting is a Stray of its own target, wherever it is; the nearest, if there are several.
  void give_tracked_strays() {
    for (std::size_t t = 0; t < targets(); ++t) {
      if (!visible(t)) continue;
      std::optional<std::size_t> nearest;
      for (const std::size_t s : left_)
        if (tracks(sighting(s), target(t)) && (!nearest || distance_px(s, t) < distance_px(*nearest, t)))
          nearest = s;
      if (nearest && open(t)) rest_on(t, *nearest, Verdict::Stray), take(*nearest);
    }
  }

  void give_false_alarms() {
    for (std::size_t i = 0; i < left_.size();) {
      const auto alarmed = absent_target_claimed(sighting(left_[i]));
      if (alarmed) {
        rest_on(*alarmed, left_[i], Verdict::FalseAlarm);
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
  }

  /// The absent target whose false alarm this is; the tracked one before one claimed by its code.
  std::optional<std::size_t> absent_target_claimed(const Sighting& seen) const {
    std::optional<std::size_t> by_code;
    for (std::size_t t = 0; t < targets(); ++t) {
      if (tracks(seen, target(t)) && visible(t)) return {};
      if (truth(t).label != Label::absent || !judged_[t] || settled_[t] || !claims(seen, target(t))) continue;
      if (tracks(seen, target(t))) return t;
      if (!by_code) by_code = t;
    }
    return by_code;
  }

  bool claims_an_absent_target(const Sighting& seen) const {
    for (std::size_t t = 0; t < targets(); ++t)
      if (truth(t).label == Label::absent && claims(seen, target(t))) return true;
    return false;
  }

  /// What is left is a Stray of the nearest visible target if that one is judged and has nothing yet.
  void give_nearest_strays() {
    const auto order = in_order_of_place(&FrameJudge::visible);
    struct Pair {
      double px;
      std::size_t rank, s, t;
      Vec2 place;
    };
    std::vector<Pair> pairs;
    for (const std::size_t s : left_) {
      if (sighting(s).track || claims_an_absent_target(sighting(s)) || order.empty()) continue;
      std::size_t rank = 0;
      for (std::size_t r = 1; r < order.size(); ++r)
        if (distance_px(s, order[r]) < distance_px(s, order[rank])) rank = r;
      pairs.push_back({distance_px(s, order[rank]), rank, s, order[rank], sighting(s).centre});
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
      return std::tie(a.px, a.rank, a.place.x, a.place.y) < std::tie(b.px, b.rank, b.place.x, b.place.y);
    });
    for (const Pair& pair : pairs)
      if (open(pair.t)) rest_on(pair.t, pair.s, Verdict::Stray), take(pair.s);
  }

  void settle_the_silent() {
    for (std::size_t t = 0; t < targets(); ++t) {
      if (!judged_[t] || settled_[t]) continue;
      settle(t, visible(t) ? Verdict::Miss : Verdict::CorrectReject);
      const auto& failed = trajectory_.failed_from[t];
      on(t).failed = visible(t) && failed && *failed <= static_cast<FrameIndex>(frame_);
    }
  }

  const Recording& recording_;
  const std::size_t frame_;
  const FrameReport& report_;
  const Trajectory& trajectory_;
  const Gate& gate_;
  FrameJudgement result_;
  std::vector<std::size_t> left_;  // sightings not yet counted
  std::vector<bool> judged_;       // for each target: its verdict depends on the sightings
  std::vector<bool> settled_;      // for each target: its verdict stands
};

}  // namespace

std::string_view to_string(Verdict verdict) { return kNames[static_cast<std::size_t>(verdict)].name; }
char letter(Verdict verdict) { return kNames[static_cast<std::size_t>(verdict)].letter; }
bool scored(Verdict verdict) { return verdict >= Verdict::Hit && verdict <= Verdict::Miss; }

std::string to_string(const Gate& gate) {
  if (gate.measure == Gate::Measure::iou) return fmt::format("iou {}, hold {}", gate.hit, gate.hold);
  return fmt::format("centre {} D, hold {} D", gate.hit, gate.hold);
}

Gate parse_gate(std::string_view text) {
  if (text == "centre") return {};
  if (text == "iou") return Gate::iou();
  throw Error(fmt::format("no gate is called \"{}\"; there are centre and iou", text));
}

FrameJudgement judge_frame(const Recording& recording, std::size_t frame, const FrameReport& report,
                           const Trajectory& trajectory, const Gate& gate) {
  if (report.delivery != Delivery::delivered && !report.sightings.empty())
    throw Error(fmt::format("frame {} was not delivered, yet there are sightings of it", frame));
  return FrameJudge(recording, frame, report, trajectory, gate).judge();
}

}  // namespace relock
