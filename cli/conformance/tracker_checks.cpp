#include <fmt/format.h>

#include <functional>
#include <limits>

#include "cli/catalogue.h"
#include "cli/conformance/checks.h"

namespace relock {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInf = std::numeric_limits<double>::infinity();

struct NamedBox {
  std::string name;
  Box box;
  bool may_be_refused = false;
};

std::string text_of_box(const NamedBox& named) {
  const Box& b = named.box;
  return fmt::format("{} (x {:g}, y {:g}, {:g} x {:g} px)", named.name, b.x, b.y, b.width, b.height);
}

/// In a picture of 160 x 120 px.
std::vector<NamedBox> legal_boxes() {
  return {{"the smallest box", {39.5, 29.5, 10, 10}},
          {"a narrow box", {39.5, 14.5, 12, 90}},
          {"a box at the left border", {-0.5, 39.5, 32, 28}},
          {"a box at the top border", {59.5, -0.5, 32, 28}},
          {"a box at the right border", {127.5, 39.5, 32, 28}},
          {"a box at the bottom border", {59.5, 91.5, 32, 28}},
          {"a box nearly half outside, at the left", {-15.5, 39.5, 32, 28}},
          {"a box nearly half outside, at a corner", {135.5, 97.5, 32, 28}},
          {"a box between the pixels", {40.3, 30.7, 31.4, 27.6}},
          {"a box of nearly the whole picture", {0.5, 0.5, 158, 118}, true}};
}

std::vector<NamedBox> boxes_that_are_none() {
  return {{"a box without a place", {kNan, 40, 32, 28}},   {"a box without a place", {30, kNan, 32, 28}},
          {"a box without a width", {30, 40, kNan, 28}},   {"a box without a height", {30, 40, 32, kNan}},
          {"a box at infinity", {-kInf, 40, 32, 28}},      {"a box at infinity", {30, kInf, 32, 28}},
          {"a box of infinite width", {30, 40, kInf, 28}}, {"a box of zero width", {30, 40, 0, 28}},
          {"a box of zero height", {30, 40, 32, 0}},       {"a box of negative width", {60, 40, -32, 28}},
          {"a box of negative height", {30, 70, 32, -28}}, {"a box beside the picture", {200, 40, 32, 28}},
          {"a box above the picture", {30, -90, 32, 28}},  {"a box far away", {1e12, -1e12, 32, 28}}};
}

std::unique_ptr<Tracker> made(const Subject& subject, const Stage& stage) {
  return stage.call([&] { return subject.tracker->make(subject.options, 1); });
}

void check_answer(const std::optional<Sighting>& sighting, Size picture, const Stage& stage) {
  if (const auto why = complaint(sighting ? Sightings{*sighting} : Sightings{}, picture)) stage.fail(*why);
}

void must_refuse(const Stage& stage, const std::function<void()>& call) {
  if (!stage.refused(call)) stage.fail("was taken, where an Error was expected");
}

Note starts(const Subject& subject, const MemoryLimits&, Stage& stage) {
  Note note;
  const Stand stand = usual_stand(subject);
  const Film film = moving(stand.scene, stand.start, {0, 0}, 2);
  for (const NamedBox& legal : legal_boxes()) {
    stage.at("start on " + text_of_box(legal));
    const auto tracker = made(subject, stage);
    const auto start = [&] { tracker->start(film.shots[0].frame(), legal.box); };
    if (!legal.may_be_refused) {
      stage.call(start);
    } else if (stage.refused(start)) {
      note = "it does not start on " + legal.name;
      continue;
    }
    for (std::size_t i = 1; i < film.shots.size(); ++i) {
      stage.at(fmt::format("frame {} after the start on {}", i, text_of_box(legal)));
      check_answer(stage.call([&] { return tracker->track(film.shots[i].frame()); }), stand.scene.size(),
                   stage);
    }
  }
  return note;
}

Note follows(const Subject& subject, const MemoryLimits&, Stage& stage) {
  constexpr double kLeastOverlap = 0.3;
  constexpr int kFrames = 20;
  constexpr Vec2 kVelocity{3, 1};
  if (is_yardstick(subject.name())) throw NotAsked("a yardstick need not follow");
  const Stand stand = usual_stand(subject);
  const Film film = moving(stand.scene, stand.start, kVelocity, kFrames);
  const auto one = stage.call([&] { return session(subject, 1); });
  const Sightings last = show(subject, *one, film, stage).back();
  if (last.empty()) stage.fail("said that the target is gone, which moves plainly in view");
  const Box truth{stand.start.x + kFrames * kVelocity.x, stand.start.y + kFrames * kVelocity.y,
                  stand.start.width, stand.start.height};
  const double overlap = intersection_over_union(bounds(last.front().outline), truth);
  if (!(overlap > kLeastOverlap))
    stage.fail(
        fmt::format("its box overlaps the target by {:.2f}; over {} was expected", overlap, kLeastOverlap));
  return fmt::format("overlap {:.2f} after {} frames", overlap, kFrames);
}

void refuse_what_comes_too_early(const Subject& subject, const Film& film, Stage& stage) {
  stage.at("a frame before the start");
  must_refuse(stage, [&] { made(subject, stage)->track(film.shots[0].frame()); });
  stage.at("a start on an empty picture");
  must_refuse(stage, [&] { made(subject, stage)->start({}, film.start); });
}

void refuse_a_second_start(const Subject& subject, const Film& film, Stage& stage) {
  stage.at("a second start on the same object");
  const auto tracker = made(subject, stage);
  stage.call([&] { tracker->start(film.shots[0].frame(), film.start); });
  stage.call([&] { tracker->track(film.shots[1].frame()); });
  must_refuse(stage, [&] { tracker->start(film.shots[2].frame(), film.start); });
  stage.at("the frame after a second start that was refused");
  stage.call([&] { tracker->track(film.shots[3].frame()); });
}

/// It may take such a picture if it can; it must not crash, and not invent a place in no picture.
void odd_pictures(const Subject& subject, const Film& film, Stage& stage) {
  const Size size = film.shots[0].picture.size;
  for (const Size other :
       {Size{size.width / 2, size.height / 2}, Size{2 * size.width, size.height}, Size{0, 0}}) {
    stage.at(other.width == 0 ? std::string("an empty picture after the start")
                              : fmt::format("a picture of {} x {} px after the start on {} x {} px",
                                            other.width, other.height, size.width, size.height));
    const auto tracker = made(subject, stage);
    stage.call([&] { tracker->start(film.shots[0].frame(), film.start); });
    const Picture picture = other.width == 0 ? Picture{} : noise(other, 3);
    std::optional<Sighting> seen;
    const Frame frame{1, film.shots[1].captured, other.width == 0 ? Image() : picture.view()};
    if (stage.refused([&] { seen = tracker->track(frame); })) continue;
    if (seen && other.width == 0) stage.fail("gave an answer, where an Error or nothing was expected");
    check_answer(seen, other, stage);
  }
}

Note refuses(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const Stand stand = usual_stand(subject);
  const Film film = moving(stand.scene, stand.start, {1, 0}, 3);
  for (const NamedBox& none : boxes_that_are_none()) {
    stage.at("start on " + text_of_box(none));
    must_refuse(stage, [&] { made(subject, stage)->start(film.shots[0].frame(), none.box); });
  }
  refuse_what_comes_too_early(subject, film, stage);
  refuse_a_second_start(subject, film, stage);
  odd_pictures(subject, film, stage);
  return {};
}

Note hints(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const Stand stand = usual_stand(subject);
  const auto odd = boxes_that_are_none();
  const Film film = moving(stand.scene, stand.start, {1, 0}, static_cast<int>(odd.size()));
  const auto tracker = made(subject, stage);
  stage.at("start");
  stage.call([&] { tracker->start(film.shots[0].frame(), film.start); });
  for (std::size_t i = 0; i < odd.size(); ++i) {
    const Shot& shot = film.shots[i + 1];
    stage.at(fmt::format("{}, told to expect {}", place_of(shot), text_of_box(odd[i])));
    stage.call([&] { tracker->expect(odd[i].box, i % 2 == 0 ? 10 : kNan); });
    check_answer(stage.call([&] { return tracker->track(shot.frame()); }), stand.scene.size(), stage);
  }
  return {};
}

}  // namespace

std::vector<Check> tracker_checks() {
  return {{"starts", starts}, {"follows", follows}, {"refuses", refuses}, {"hints", hints}};
}

}  // namespace relock
