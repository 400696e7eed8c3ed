#include <fmt/format.h>

#include <deque>

#include "cli/conformance/checks.h"
#include "cli/conformance/guarded_picture.h"

namespace relock {
namespace {

Film short_film(const Stand& stand) { return moving(stand.scene, stand.start, {3, 1}, 3); }

Film in_grey(Film film) {
  for (Shot& shot : film.shots) shot.picture = grey_of(shot.picture);
  return film;
}

/// Shows the film with each picture in memory of its own; after each call `afterwards` has that memory.
template <class Afterwards>
std::vector<std::string> show_guarded(const Subject& subject, const Film& film, Guard guard,
                                      std::uint8_t between, Stage& stage, const Afterwards& afterwards) {
  std::deque<GuardedPicture> pictures;
  std::vector<std::string> answers;
  const auto one = stage.call([&] { return session(subject, 1); });
  for (std::size_t i = 0; i < film.shots.size(); ++i) {
    const Shot& shot = film.shots[i];
    const Frame frame = shot.frame(pictures.emplace_back(shot.picture, guard, between).image());
    const bool is_start = subject.tracker && i == 0;
    stage.at(is_start ? "start" : place_of(shot));
    if (is_start) {
      stage.call([&] { one->start(frame, film.start); });
    } else {
      answers.push_back(text_of(stage.call([&] { return one->see(frame); })));
    }
    afterwards(pictures.back());
  }
  return answers;
}

void nothing(const GuardedPicture&) {}

/// Detectors may refuse grey or colour; then the pixels are not looked at.
std::vector<Film> films(const Subject& subject, Stage& stage) {
  const Film colour = short_film(usual_stand(subject));
  std::vector<Film> taken;
  for (const Film& film : {colour, in_grey(colour)}) {
    stage.at("a picture to see whether its format is taken");
    const auto one = stage.call([&] { return session(subject, 1); });
    if (subject.detector && stage.refused([&] { one->see(film.shots.front().frame()); })) continue;
    taken.push_back(film);
  }
  return taken;
}

Note writes(const Subject& subject, const MemoryLimits&, Stage& stage) {
  tell_wrong_touches();
  for (const Film& film : films(subject, stage))
    show_guarded(subject, film, Guard::writing, 0, stage, nothing);
  return {};
}

Note rows(const Subject& subject, const MemoryLimits&, Stage& stage) {
  tell_wrong_touches();
  for (const Film& film : films(subject, stage)) {
    show_guarded(subject, film, Guard::before, 0, stage, nothing);
    const auto with_black = show_guarded(subject, film, Guard::behind, 0, stage, nothing);
    const auto with_white = show_guarded(subject, film, Guard::behind, 255, stage, nothing);
    if (subject.deterministic() && with_black != with_white)
      stage.fail("its answers change with the bytes between the rows, which are no pixels");
  }
  return {};
}

Note keeps(const Subject& subject, const MemoryLimits&, Stage& stage) {
  tell_wrong_touches();
  for (const Film& film : films(subject, stage))
    show_guarded(subject, film, Guard::later, 0, stage, [](GuardedPicture& seen) { seen.take_away(); });
  return {};
}

}  // namespace

std::vector<Check> pixel_checks() { return {{"writes", writes}, {"rows", rows}, {"keeps", keeps}}; }

}  // namespace relock
