#include <fmt/format.h>

#include <limits>

#include "cli/conformance/checks.h"

namespace relock {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInf = std::numeric_limits<double>::infinity();

std::unique_ptr<Detector> made(const Subject& subject, const Stage& stage) {
  return stage.call([&] { return subject.detector->make(subject.options, 1); });
}

Note finds(const Subject& subject, const MemoryLimits&, Stage& stage) {
  if (!subject.family) throw NotAsked("it reads no code whose print relock can draw");
  const Stand stand = usual_stand(subject);
  stage.at("a marker of " + *subject.family + " in plain view");
  const auto detector = made(subject, stage);
  const Picture picture = stand.scene.with_target(stand.start);
  const Sightings seen = stage.call([&] { return detector->detect(picture.view()); });
  if (const auto why = complaint(seen, picture.size)) stage.fail(*why);
  for (const Sighting& one : seen)
    if (one.code && one.code->family == *subject.family && share_inside(one.outline, stand.start) > 0.5)
      return {};
  stage.fail("answered with " + text_of(seen) + ", where the marker was expected");
}

Note pictures(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const auto detector = made(subject, stage);
  for (const Size size : {Size{160, 120}, Size{1, 1}, Size{2, 2}, Size{1, 200}, Size{200, 1}, Size{17, 3},
                          Size{31, 32}, Size{640, 480}, Size{2000, 20}, Size{20, 2000}, Size{160, 120}})
    for (const Picture& picture : {noise(size, 7), grey_of(noise(size, 7))}) {
      stage.at(fmt::format("a picture of {} x {} px{}", size.width, size.height,
                           picture.format == PixelFormat::gray8 ? ", grey" : ""));
      Sightings seen;
      if (stage.refused([&] { seen = detector->detect(picture.view()); })) continue;
      if (const auto why = complaint(seen, size)) stage.fail(*why);
    }
  stage.at("an empty picture");
  Sightings seen;
  if (!stage.refused([&] { seen = detector->detect(Image()); }) && !seen.empty())
    stage.fail("found something, where an Error or nothing was expected");
  return {};
}

Note hints(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const Stand stand = usual_stand(subject);
  const Picture picture = stand.scene.with_target(stand.start);
  const auto detector = made(subject, stage);
  for (const Box where :
       {Box{0, 0, 0, 0}, Box{kNan, 0, 10, 10}, Box{0, 0, kNan, 10}, Box{-kInf, -kInf, kInf, kInf},
        Box{0, 0, 1e300, 1e300}, Box{-1e9, -1e9, 2e9, 2e9}, Box{500, 500, 20, 20}, Box{-40, -40, 50, 50},
        Box{150, 110, 100, 100}, Box{50, 50, -20, -20}, Box{20.2, 30.7, 0.3, 0.3}, Box{159.4, 10, 5, 5},
        Box{10, 20, 70, 3}, stand.start}) {
    stage.at(fmt::format("told to look at x {:g}, y {:g}, {:g} x {:g} px", where.x, where.y, where.width,
                         where.height));
    const Sightings seen = stage.call([&] { return detector->detect(picture.view(), where); });
    if (const auto why = complaint(seen, picture.size)) stage.fail(*why);
  }
  return {};
}

Note forgets(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const Stand stand = usual_stand(subject);
  const Picture picture = stand.scene.with_target(stand.start);
  const auto detector = made(subject, stage);
  stage.at("a picture that is shown first");
  const std::string first = text_of(stage.call([&] { return detector->detect(picture.view()); }));
  Film between = blank(stand.scene, {70.5, 34.5, stand.start.width, stand.start.height});
  between.add(stand.scene.wall());
  for (const Shot& shot : between.shots) {
    stage.at(place_of(shot) + ", in between");
    stage.call([&] { return detector->detect(shot.picture.view()); });
    stage.at("the first picture again, after " + place_of(shot));
    const std::string again = text_of(stage.call([&] { return detector->detect(picture.view()); }));
    if (again != first) stage.fail(fmt::format("answered with {}, and with {} at first", again, first));
  }
  return {};
}

}  // namespace

std::vector<Check> detector_checks() {
  return {{"finds", finds}, {"pictures", pictures}, {"hints", hints}, {"forgets", forgets}};
}

}  // namespace relock
