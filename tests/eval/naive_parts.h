#pragma once

#include <cstddef>
#include <vector>

#include "eval/scores/scores.h"

// What the parts of the naive evaluator tell each other.
namespace relock::naive {

// Section 1.
double distance(Vec2 a, Vec2 b);
double times(Vec2 a, Vec2 b);  // scalar product
Vec2 outline_centre(const Outline& outline);
double outline_size(const Outline& outline);
double overlap(const Outline& a, const Outline& b);  // of the boxes around them
Vec2 matching_centre(const TargetTruth& truth, CentreKind kind);

// Section 3.
bool is_scored(Verdict verdict);
FrameJudgement judge(const Recording& recording, std::size_t frame, const Trajectory& trajectory,
                     const Gate& gate);

// Section 4. One target on every recorded frame.
struct Look {
  Time captured;
  Label label = Label::unlabelled;
  Verdict verdict = Verdict::NotStarted;
  bool hold = false;
  Vec2 reported;  // where there is a sighting
  Vec2 truth;     // the centre it is compared with
  double size = 0;
};
using Looks = std::vector<Look>;
Looks looks_of(const Recording& recording, const Trajectory& trajectory, std::size_t target,
               const std::vector<Judgement>& judgements);

struct Story {
  std::vector<State> states;
  std::vector<Loss> losses;
  std::vector<Acquisition> acquisitions;
};
Story story_of(const Looks& looks, Duration period);

// The last frame before k of a kind; nothing when there is none.
std::optional<std::size_t> last_before(const Looks& looks, std::size_t k, bool (*is)(const Look&));
std::array<int, kLossKinds> said_while_lost(const Looks& looks, const Loss& loss, std::size_t end);
LossKind largest_share(const std::array<int, kLossKinds>& said);
bool is_chance(const Looks& looks, const Loss& loss, std::size_t first_hit);

bool is_labelled(const Look& look);
bool unlabelled_between(const Looks& looks, std::size_t j, std::size_t k);
bool pause_between(const Looks& looks, std::size_t j, std::size_t k);

// Section 6. A loss from its early onset to its end.
struct Watched {
  Duration time;
  bool recovered;
};
Recovery recovery_of(const std::vector<Watched>& losses);

// A stretch of visible time.
struct Interval {
  std::size_t frame;  // the labelled frame it begins at
  Time from, to;
};
Duration common(Time a, Time a_end, Time b, Time b_end);  // of two stretches of time

// Time over which the newest Hit ages, beginning so old: nothing when there was none yet.
struct Ageing {
  std::optional<Duration> from;
  Duration length;
};
std::vector<Ageing> ageings(const std::vector<Interval>& visible, const std::vector<Time>& hits);
FixAge fix_age_of(const std::vector<Ageing>& ageings);

LostTime lost_time_of(const Looks& looks, const TargetTimeline& timeline,
                      const std::vector<Interval>& visible);

std::size_t blur_bin(const TargetTruth& truth);
std::size_t gap_bin(const Looks& looks, std::size_t k, Duration period);

}  // namespace relock::naive
