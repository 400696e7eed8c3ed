#include "tests/eval/made_flight.h"

#include "core/error.h"
#include "eval/judgement/evaluation.h"

namespace relock {

Recording made_flight(const std::string& letters) {
  Recording made;
  made.name = "made";
  made.picture = {640, 360};
  made.period = period_of(30);
  made.targets = {{"target"}};
  for (std::size_t i = 0; i < letters.size(); ++i) {
    made.captured.push_back(Time{static_cast<std::int64_t>(i) * made.period});
    TargetTruth truth;
    truth.label = letters[i] == 'a' ? Label::absent : letters[i] == '?' ? Label::unlabelled : Label::visible;
    if (truth.label == Label::visible) truth.outline = Box{100 + static_cast<double>(i), 100, 40, 40};
    if (letters[i] == 'o') truth.occluded_fraction = 0.4;
    made.truth.push_back(truth);
  }
  return made;
}

Trajectory said(const Recording& recording, const std::string& letters, Vec2 aside) {
  Trajectory made;
  made.judged_from = {0};
  made.failed_from = {std::nullopt};
  for (std::size_t i = 0; i < letters.size(); ++i) {
    FrameReport report;
    if (letters[i] == '.') report.delivery = Delivery::dropped;
    if (letters[i] == 'g') report.given = {0};
    Box box = bounds(*recording.truth_of(i, 0).outline);
    if (letters[i] == 'S') box.x += aside.x, box.y += aside.y;
    if (letters[i] == 'H' || letters[i] == 'S') report.sightings = {sighting_of(box)};
    made.frames.push_back(report);
  }
  return made;
}

std::string verdicts(const Recording& recording, const Trajectory& trajectory, std::size_t target) {
  std::string line;
  const Evaluation evaluation = evaluate(recording, trajectory);
  for (const Judgement& j : evaluation.targets[target].judgements) line += letter(j.verdict);
  return line;
}

MadeFrames::MadeFrames(const Recording& recording, FrameIndex unreadable_from)
    : recording_(recording),
      unreadable_from_(unreadable_from),
      pixels_(static_cast<std::size_t>(recording.picture.width * recording.picture.height)) {}

std::optional<FrameStamp> MadeFrames::next() {
  if (++at_ >= static_cast<FrameIndex>(recording_.frames())) return {};
  return FrameStamp{at_, recording_.captured[static_cast<std::size_t>(at_)]};
}

Image MadeFrames::image() {
  if (unreadable_from_ >= 0 && at_ >= unreadable_from_) throw Error("a picture that cannot be read");
  return Image(pixels_.data(), recording_.picture, PixelFormat::gray8,
               static_cast<std::size_t>(recording_.picture.width));
}

}  // namespace relock
