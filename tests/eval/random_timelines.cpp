#include "tests/eval/random_timelines.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/random.h"

namespace relock {
namespace {

using std::size_t;

int between(Random& random, int low, int high) {
  return low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low + 1)));
}
template <class T>
T one_of(Random& random, std::initializer_list<T> choices) {
  return choices.begin()[random.below(choices.size())];
}

// --- The recording.

std::vector<Time> capture_times(Random& random, int frames, Duration period) {
  const double gaps = one_of(random, {0.0, 0.05, 0.05, 0.2}), pauses = one_of(random, {0.0, 0.0, 0.01, 0.03});
  const std::int64_t jitter = one_of(random, {0, 0, 1, 6}) * period.count() / 20;
  std::vector<Time> times;
  Time now = time_ns(between(random, -5, 5) * 1'000'000'000LL);
  for (int k = 0; k < frames; ++k) {
    times.push_back(now);
    Duration step = period;
    if (random.chance(gaps)) step = between(random, 2, 7) * period;
    if (jitter > 0)
      step +=
          Duration(static_cast<std::int64_t>(random.below(2 * static_cast<std::uint64_t>(jitter))) - jitter);
    if (random.chance(pauses))
      step = one_of<Duration>(
          random, {std::chrono::seconds(5), std::chrono::milliseconds(5001), std::chrono::seconds(9)});
    now += step;
  }
  return times;
}

std::optional<Code> some_code(Random& random) {
  if (random.chance(0.3)) return {};
  return Code{"dot", one_of<std::string>(random, {"1", "2", "3"})};
}

// Where a target is on every frame: whole pixels.
std::vector<Vec2> path(Random& random, int frames) {
  const Vec2 start{4.0 * between(random, 10, 40), 4.0 * between(random, 8, 25)};
  const Vec2 step{1.0 * between(random, -4, 4), random.chance(0.6) ? 0.0 : 1.0 * between(random, -2, 2)};
  const int half_period =
      one_of(random, {0, 8, 8, 12, 12, 16, 24, 1000});  // 0: it stays; 1000: it does not come back
  std::vector<Vec2> places;
  for (int k = 0; k < frames; ++k) {
    int out = 0;
    if (half_period > 0) {
      const int phase = k % (2 * half_period);
      out = phase <= half_period ? phase : 2 * half_period - phase;
    }
    places.push_back(start + static_cast<double>(out) * step);
  }
  return places;
}

struct Shape {
  int kind = 0;  // box, quad, ellipse
  double width = 24, height = 24;

  Outline at(Vec2 centre) const {
    if (kind == 0) return Box{centre.x - width / 2, centre.y - height / 2, width, height};
    if (kind == 2) return Ellipse{centre, width / 2, height / 2, 0.25 * std::floor(width / 12)};
    // Off the grid and moving off it, for the centroid of a quad is not exact to the last bit: no ties here.
    const Vec2 c = 1.0007 * centre + Vec2{0.137, 0.291};
    const double w = width / 2, h = height / 2;
    return Quad{{Vec2{c.x - w, c.y - h}, Vec2{c.x + w, c.y - h + 2}, Vec2{c.x + w - 3, c.y + h},
                 Vec2{c.x - w, c.y + h - 1}}};
  }
};
Shape some_shape(Random& random) {
  const int kind = one_of(random, {0, 0, 0, 1, 2});
  const double size = one_of(random, {16.0, 24.0, 24.0, 32.0, 40.0});
  if (random.chance(0.7)) return {kind, size, size};
  return {kind, 2 * size, size / 2};
}

std::vector<Label> labels(Random& random, int frames) {
  const int visible = one_of(random, {200, 200, 60, 25, 12}), hidden = one_of(random, {2, 6, 20});
  const double unlabelled = one_of(random, {0.0, 0.4, 0.5, 1.0});
  std::vector<Label> all;
  while (static_cast<int>(all.size()) < frames) {
    const bool hide = all.empty() ? random.chance(0.15) : all.back() == Label::visible || random.chance(0.2);
    const Label label = !hide                       ? Label::visible
                        : random.chance(unlabelled) ? Label::unlabelled
                                                    : Label::absent;
    all.insert(all.end(), static_cast<size_t>(between(random, 1, 2 * (hide ? hidden : visible))), label);
  }
  all.resize(static_cast<size_t>(frames));
  return all;
}

Recording some_recording(Random& random) {
  Recording recording;
  recording.name = "random";
  recording.picture = {200, 150};
  const int frames = random.chance(0.1) ? between(random, 1, 8) : between(random, 40, 120);
  const Duration step =
      one_of<Duration>(random, {Duration(33'333'333), Duration(33'333'334), std::chrono::milliseconds(30),
                                std::chrono::milliseconds(40), std::chrono::milliseconds(100)});
  recording.captured = capture_times(random, frames, step);
  recording.period = step;
  if (frames > 1 && random.chance(0.5)) recording.period = nominal_period(recording.captured);
  // Stated otherwise: 2 intervals are 1.5 T, or 3 are 2.5 T, to the nanosecond.
  if (random.chance(0.2)) recording.period = random.chance(0.5) ? 4 * step / 3 : 6 * step / 5;

  const int targets = one_of(random, {1, 1, 1, 2, 2, 3, 4});
  recording.truth.resize(static_cast<size_t>(frames * targets));
  for (int t = 0; t < targets; ++t)
    recording.targets.push_back({"target" + std::to_string(t), some_code(random), {}});
  std::vector<Vec2> places;
  for (int t = 0; t < targets; ++t) {
    if (places.empty() || !random.chance(0.3))
      places = path(random, frames);  // else it coincides with the one before
    const auto labelled = labels(random, frames);
    const Shape shape = some_shape(random);
    const bool known_when_unlabelled = random.chance(0.5), knows_projected = random.chance(0.3);
    const double sigma = one_of(random, {0.0, 0.0, 0.5});
    const int blurred = one_of(random, {0, 0, 1, 2});  // no, along y, along (3, 4)
    for (int k = 0; k < frames; ++k) {
      const auto frame = static_cast<size_t>(k);
      TargetTruth& truth = recording.truth_of(frame, static_cast<size_t>(t));
      truth.label = labelled[frame];
      if (truth.label == Label::visible ||
          (truth.label == Label::unlabelled && known_when_unlabelled && k % 16 < 12))
        truth.outline = shape.at(places[frame]);
      if (truth.outline && knows_projected) truth.centre_projected = places[frame] + Vec2{2, 1};
      if (blurred > 0 && !random.chance(0.1)) {  // 0 to 100 px, and just that of each bin's end
        const double length = one_of(random, {0, 0, 1, 1, 2, 3, 4, 6, 8, 12, 16, 20});
        truth.blur = BlurVector{3 * (blurred - 1) * length, 4 * length};
      }
      truth.sigma_px = sigma;
    }
  }
  return recording;
}

// --- The method.

enum class Mood { follow, graze, offset, wander, freeze, silent, impostor };

Mood any_bad_mood(Random& random) {
  return one_of(random, {Mood::graze, Mood::offset, Mood::offset, Mood::wander, Mood::freeze, Mood::freeze,
                         Mood::freeze, Mood::silent, Mood::impostor, Mood::impostor});
}

// What one method says of one target, frame by frame. It also knows the place of an absent one from before.
struct Follower {
  size_t target;
  Shape shape;
  bool tracks = false, reads = false;
  int patience = 10;  // frames for which it keeps a mood, about
  Mood mood = Mood::follow;
  Vec2 last{100, 60};
  Vec2 aside{6, 0};
  double temper = 0.5;  // share of moods that are good

  Mood vice = Mood::wander;  // its commonest bad mood

  Mood next_mood(Random& random) const {
    if (random.chance(temper)) return Mood::follow;
    if (random.chance(0.7)) return vice;
    return any_bad_mood(random);
  }

  std::optional<Sighting> look(Random& random, const Recording& recording, size_t frame) {
    const TargetTruth& truth = recording.truth_of(frame, target);
    if (random.chance((mood == Mood::freeze ? 0.3 : 1.0) / patience)) {
      mood = next_mood(random);
      const double size = shape.kind == 0 ? std::sqrt(shape.width * shape.height) : shape.width;
      const double part = mood == Mood::graze ? one_of(random, {0.25, 0.5}) : 0.375;
      aside = random.chance(0.5) ? Vec2{std::round(part * size), 0} : Vec2{0, -std::round(part * size)};
    }
    if (mood == Mood::silent) return {};
    if (truth.label == Label::absent && !random.chance(mood == Mood::follow ? 0.1 : 0.6)) return {};
    const bool projected = truth.centre_projected && random.chance(0.3);
    const Vec2 place =
        truth.outline ? truth.centre(projected ? CentreKind::projected : CentreKind::outline) : last;
    if (mood == Mood::follow || mood == Mood::impostor)
      last = place + Vec2{1.0 * between(random, -2, 2), 1.0 * between(random, -1, 1)};
    if (mood == Mood::offset || mood == Mood::graze) last = place + aside;
    if (mood == Mood::wander) last = Vec2{4.0 * between(random, 2, 48), 4.0 * between(random, 2, 36)};
    if (truth.outline && std::holds_alternative<Quad>(*truth.outline) && mood != Mood::freeze)
      last = last + Vec2{0.31, 0.17};
    Sighting sighting;
    sighting.centre = last;
    sighting.centre_kind = projected ? CentreKind::projected : CentreKind::outline;
    sighting.outline = shape.at(last);
    if (tracks) sighting.track = recording.targets[target].id;
    if (reads && random.chance(0.8)) sighting.code = recording.targets[target].code;
    if (reads && (mood == Mood::impostor || random.chance(0.03)))
      sighting.code = Code{"dot", one_of<std::string>(random, {"1", "2", "9"})};
    if (random.chance(0.5))
      sighting.blur = BlurEstimate{.direction_rad = 0.1 * between(random, 0, 31),
                                   .length_px = 1.0 * between(random, 0, 30)};
    return sighting;
  }
};

// Anything anywhere: a shout, a second answer at the same place, a claim of someone.
Sighting shout(Random& random, const Recording& recording, const Sightings& said) {
  if (!said.empty() && random.chance(0.4)) {
    Sighting again = said[random.below(said.size())];
    if (random.chance(0.4)) again.code = some_code(random);
    if (random.chance(0.3)) again.centre = again.centre + Vec2{4, 0};
    return again;
  }
  Sighting sighting = sighting_of(Box{8.0 * between(random, 1, 22), 8.0 * between(random, 1, 15), 24, 24});
  if (random.chance(0.4)) sighting.code = some_code(random);
  if (random.chance(0.2)) sighting.track = recording.targets[random.below(recording.targets.size())].id;
  return sighting;
}

Trajectory some_trajectory(Random& random, const Recording& recording) {
  const size_t frames = recording.frames(), targets = recording.targets.size();
  Trajectory trajectory;
  trajectory.frames.resize(frames);
  trajectory.reads_codes = random.chance(0.5);
  const bool tracker = random.chance(0.6);
  const double shouting = one_of(random, {0.0, 0.05, 0.5}), resets = one_of(random, {0.0, 0.0, 0.04, 0.2});
  const double dropped = one_of(random, {0.0, 0.0, 0.1, 0.4}), skipped = one_of(random, {0.0, 0.0, 0.0, 0.3});
  const double withheld = one_of(random, {0.0, 0.0, 0.0, 0.2});
  const int patience = one_of(random, {4, 10, 20, 40});
  const double temper = one_of(random, {0.3, 0.5, 0.7});
  const Mood vice = any_bad_mood(random);

  std::vector<Follower> followers;
  for (size_t t = 0; t < targets; ++t) {
    Follower follower{.target = t,
                      .shape = some_shape(random),
                      .tracks = tracker && random.chance(0.9),
                      .reads = trajectory.reads_codes,
                      .patience = patience,
                      .temper = temper,
                      .vice = vice};
    const auto place =
        std::find_if(recording.truth.begin() + static_cast<std::ptrdiff_t>(t), recording.truth.end(),
                     [](const TargetTruth& x) { return x.outline.has_value(); });
    if (place != recording.truth.end() && random.chance(0.7)) {  // mostly of the target's own size
      const double size = size_of(*place->outline);
      follower.shape = {0, size, size};
    }
    followers.push_back(follower);
    std::optional<FrameIndex> from = one_of(random, {0, 0, 0, 1, 5, 12});
    if (random.chance(0.05)) from.reset();
    trajectory.judged_from.push_back(from);
    trajectory.failed_from.push_back(random.chance(0.08) ? std::optional<FrameIndex>(between(random, 0, 100))
                                                         : std::nullopt);
  }

  std::vector<bool> started(targets, false);
  for (size_t k = 0; k < frames; ++k) {
    FrameReport& report = trajectory.frames[k];
    const auto rank = static_cast<FrameIndex>(k);
    if (random.chance(dropped))
      report.delivery = Delivery::dropped;
    else if (random.chance(skipped))
      report.delivery = Delivery::skipped;
    if (report.delivery != Delivery::delivered) continue;
    for (Follower& follower : followers) {
      const size_t t = follower.target;
      const auto from = trajectory.judged_from[t], failed = trajectory.failed_from[t];
      if (failed && *failed <= rank) continue;
      const bool judged = from && *from <= rank, visible = recording.truth_of(k, t).label == Label::visible;
      if (tracker && judged && visible &&
          (started[t] ? random.chance(follower.mood == Mood::follow ? resets / 2 : resets)
                      : random.chance(0.8))) {
        report.given.push_back(t);
        started[t] = true;
        follower.mood = Mood::follow;
      }
      if (!std::binary_search(report.given.begin(), report.given.end(), t) && random.chance(withheld))
        report.withheld.push_back(t);
      if (!judged && random.chance(0.5)) continue;
      if (const auto sighting = follower.look(random, recording, k)) report.sightings.push_back(*sighting);
    }
    while (report.sightings.size() < 6 && random.chance(shouting))
      report.sightings.push_back(shout(random, recording, report.sightings));
    for (size_t i = report.sightings.size(); i > 1; --i)
      std::swap(report.sightings[i - 1], report.sightings[random.below(i)]);
  }
  return trajectory;
}

// Who labelled: most often nobody says; else people, curves and methods, in stretches.
void name_sources(Random& random, Case& drawn) {
  drawn.trajectory.method = one_of(random, {"ring", "hybrid(ring,kcf)", "ring-paper(k=5)", "csrt"});
  if (random.chance(0.5)) return;
  LabelSource source;
  for (TargetTruth& truth : drawn.recording.truth) {
    if (random.chance(0.2))
      source = parse_label_source(
          one_of(random, {"", "hand", "spline", "detector ring", "spline detector kcf+ring"}));
    truth.source = source;
  }
}

}  // namespace

Case random_case(std::uint64_t seed) {
  Random random(seed);
  Case drawn;
  drawn.recording = some_recording(random);
  drawn.trajectory = some_trajectory(random, drawn.recording);
  name_sources(random, drawn);
  return drawn;
}

}  // namespace relock
