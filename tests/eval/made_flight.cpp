#include "tests/eval/made_flight.h"

#include "core/error.h"

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
