#include "eval/compatibility/answers.h"

#include <algorithm>
#include <cctype>

namespace relock {
namespace {

bool gives(const FrameReport& report, std::size_t target) {
  return std::find(report.given.begin(), report.given.end(), target) != report.given.end();
}

/// Where a method that is handed boxes got its first one; else the frame before it is judged.
std::size_t start_frame(const Trajectory& trajectory, std::size_t target) {
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i)
    if (gives(trajectory.frames[i], target)) return i;
  const auto judged = static_cast<std::size_t>(*trajectory.judged_from[target]);
  return judged > 0 ? judged - 1 : 0;
}

}  // namespace

std::optional<Outline> answer_for(const Recording& recording, const FrameReport& report, std::size_t target) {
  const Target& asked = recording.targets[target];
  const auto first = [&](const auto& fits) -> std::optional<Outline> {
    const auto found = std::find_if(report.sightings.begin(), report.sightings.end(), fits);
    return found == report.sightings.end() ? std::nullopt : std::optional(found->outline);
  };
  if (const auto followed = first([&](const Sighting& s) { return s.track == asked.id; })) return followed;
  const auto codes = [&](const Sighting& s) { return !s.track && s.code && s.code == asked.code; };
  if (const auto read = first(codes)) return read;
  if (recording.targets.size() > 1) return {};
  return first([](const Sighting& s) { return !s.track; });
}

std::string sequence_name(const Recording& recording, std::size_t target) {
  std::string name = recording.name;
  if (recording.targets.size() > 1) name += "-" + recording.targets[target].id;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '-';
  return name;
}

std::optional<AnsweredSequence> answers_for(const Recording& recording, const Trajectory& trajectory,
                                            std::size_t target) {
  if (!trajectory.judged_from[target]) return {};
  AnsweredSequence sequence{
      sequence_name(recording, target), recording.picture, start_frame(trajectory, target), {}};
  for (std::size_t i = sequence.first_frame; i < trajectory.frames.size(); ++i) {
    const TargetTruth& truth = recording.truth_of(i, target);
    AnsweredFrame frame{truth.outline, truth.visible_fraction, gives(trajectory.frames[i], target), {}};
    frame.answer = frame.given ? truth.outline : answer_for(recording, trajectory.frames[i], target);
    frame.judged = trajectory.frames[i].delivery == Delivery::delivered && truth.label == Label::visible;
    sequence.frames.push_back(std::move(frame));
  }
  return sequence;
}

}  // namespace relock
