#include "cli/conformance/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/catalogue.h"
#include "cli/combinations.h"
#include "detectors/apriltag.h"
#include "detectors/aruco.h"

namespace relock {
namespace {

class TrackerSession final : public Session {
 public:
  explicit TrackerSession(std::unique_ptr<Tracker> tracker) : tracker_(std::move(tracker)) {}
  void start(const Frame& frame, const Box& box) override { tracker_->start(frame, box); }
  Sightings see(const Frame& frame) override {
    auto sighting = tracker_->track(frame);
    return sighting ? Sightings{*std::move(sighting)} : Sightings{};
  }

 private:
  std::unique_ptr<Tracker> tracker_;
};

class DetectorSession final : public Session {
 public:
  explicit DetectorSession(std::unique_ptr<Detector> detector) : detector_(std::move(detector)) {}
  void start(const Frame&, const Box&) override {}
  Sightings see(const Frame& frame) override { return detector_->detect(frame.image); }

 private:
  std::unique_ptr<Detector> detector_;
};

Look look_for(const Subject& subject) {
  if (subject.family)
    if (const auto print = print_of(*subject.family)) return printed(*print);
  return textured(5);
}

std::optional<std::string> complaint_about(const Sighting& s, Size picture) {
  if (!well_formed(s.outline)) return "its outline has a number that is not finite, or no area";
  const Box box = bounds(s.outline);
  const std::string place =
      fmt::format("x {:.1f} to {:.1f}, y {:.1f} to {:.1f}", box.x, box.right(), box.y, box.bottom());
  if (!(share_inside(s.outline, picture_box(picture)) > 0))
    return fmt::format("it lies at {}, outside of the picture of {} x {} px", place, picture.width,
                       picture.height);
  if (!finite(s.centre)) return "its centre is not finite";
  const double reach = 0.5 * size_of(s.outline);
  const Box near{box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach};
  if (!(s.centre.x >= near.x && s.centre.x <= near.right() && s.centre.y >= near.y &&
        s.centre.y <= near.bottom()))
    return fmt::format("its centre ({:.1f}, {:.1f}) is far from its outline at {}", s.centre.x, s.centre.y,
                       place);
  if (!(s.confidence >= 0 && s.confidence <= 1))
    return fmt::format("its confidence is {}; it must be from 0 to 1", s.confidence);
  if (s.blur && !(s.blur->direction_rad >= 0 && s.blur->direction_rad < std::numbers::pi))
    return fmt::format("its direction of blur is {}; it must be from 0 to below pi", s.blur->direction_rad);
  if (s.blur && !(std::isfinite(s.blur->length_px) && s.blur->length_px >= 0))
    return fmt::format("its length of blur is {} px; it must be finite and not below 0", s.blur->length_px);
  if (s.code && (s.code->family.empty() || s.code->value.empty()))
    return "its code lacks a family or a value";
  return {};
}

}  // namespace

std::optional<MarkerCells> print_of(const std::string& family) {
  constexpr int kSome = 7;
  try {
    if (family.starts_with("aruco")) return aruco_cells(family.substr(5), kSome);
    if (family.starts_with("apriltag")) return apriltag_cells(family.substr(5), kSome);
  } catch (const Error&) {  // another one's family that is called alike
  }
  return {};
}

Subject subject_called(const Methods& methods, const MethodSpec& spec) {
  Subject subject;
  if (is_tracker_combination(spec.name)) {
    auto bound = bound_tracker(methods, spec);
    subject.combined = std::make_shared<const TrackerEntry>(std::move(bound.entry));
    subject.tracker = subject.combined.get();
  } else if (is_combination(spec.name)) {
    throw Error(fmt::format("{} is a whole method: check the tracker and the detector that it is made of",
                            spec.text()));
  } else {
    subject.tracker = methods.trackers.find(spec.name);
    if (!subject.tracker) subject.detector = methods.detectors.find(spec.name);
  }
  if (!subject.tracker && !subject.detector) {
    if (is_yardstick(spec.name))
      throw Error(
          fmt::format("{} is no method: it marks an end of the scale, and has nothing to check", spec.name));
    throw unknown_method(methods, spec.name);
  }
  subject.options = Options(spec.name, subject.option_list(), spec.options);
  subject.text = spec.text();
  return subject;
}

std::unique_ptr<Session> session(const Subject& subject, std::uint64_t seed) {
  if (subject.tracker) return std::make_unique<TrackerSession>(subject.tracker->make(subject.options, seed));
  return std::make_unique<DetectorSession>(subject.detector->make(subject.options, seed));
}

Stand usual_stand(const Subject& subject) {
  const Box box = subject.family ? Box{14.5, 24.5, 60, 60} : Box{29.5, 39.5, 32, 28};
  return {Scene({160, 120}, look_for(subject), 11), box};
}

Stand small_stand(const Subject& subject) {
  const Box box = subject.family ? Box{9.5, 7.5, 50, 50} : Box{19.5, 19.5, 24, 20};
  return {Scene({96, 72}, look_for(subject), 12), box};
}

std::optional<std::string> complaint(const Sightings& sightings, Size picture) {
  constexpr std::size_t kMost = 1000;
  if (sightings.size() > kMost)
    return fmt::format("answered with {} sightings; more than {} are of no use", sightings.size(), kMost);
  for (const Sighting& one : sightings)
    if (const auto why = complaint_about(one, picture)) return "gave an answer that is none: " + *why;
  return {};
}

std::string text_of(const Sightings& sightings) {
  if (sightings.empty()) return "nothing";
  std::string text;
  for (const Sighting& s : sightings) {
    const Box box = bounds(s.outline);
    text += fmt::format("{}centre ({}, {}), {} x {} px, confidence {}", text.empty() ? "" : "; ", s.centre.x,
                        s.centre.y, box.width, box.height, s.confidence);
    if (s.code) text += ", " + to_string(*s.code);
    if (s.blur) text += fmt::format(", blur {} rad {} px", s.blur->direction_rad, s.blur->length_px);
  }
  return text;
}

std::string place_of(const Shot& shot) {
  return fmt::format("frame {}{}", shot.index, shot.what.empty() ? "" : " (" + shot.what + ")");
}

std::vector<Sightings> show(const Subject& subject, Session& session, const Film& film, Stage& stage,
                            Refusal refusal) {
  std::vector<Sightings> answers;
  const std::size_t first = subject.tracker ? 1 : 0;
  stage.at("start");
  stage.call([&] { session.start(film.shots.front().frame(), film.start); });
  for (std::size_t i = first; i < film.shots.size(); ++i) {
    const Shot& shot = film.shots[i];
    stage.at(place_of(shot));
    Sightings seen;
    const auto see = [&] { seen = session.see(shot.frame()); };
    if (refusal == Refusal::is_allowed) {
      if (stage.refused(see)) continue;
    } else {
      stage.call(see);
    }
    if (const auto why = complaint(seen, shot.picture.size)) stage.fail(*why);
    answers.push_back(std::move(seen));
  }
  return answers;
}

}  // namespace relock
