#include "eval/loss_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "eval/scores/scores.h"

namespace relock {
namespace {

std::string how_lost(LossKind kind) {
  switch (kind) {
    case LossKind::Silent:
      return "lost silently";
    case LossKind::WrongId:
      return "taken for another";
    case LossKind::Drift:
      return "drifted off";
    case LossKind::Declared:
      break;
  }
  return "lost, and said so,";
}

double at(const Recording& recording, FrameIndex frame) {
  return seconds(recording.captured[static_cast<std::size_t>(frame)] - recording.captured.front());
}

}  // namespace

std::string joined(const std::vector<std::string>& words) {
  if (words.empty()) return "";
  std::string text = words[0];
  for (std::size_t i = 1; i < words.size(); ++i) text += (i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string onset_text(const Recording& recording, const Loss& loss, const Circumstances& circumstances,
                       std::string_view gap_note) {
  const Duration onset = recording.captured[static_cast<std::size_t>(loss.first_lost)] -
                         recording.captured[static_cast<std::size_t>(loss.last_good)];
  if (slots(onset, recording.period) < 2)
    return fmt::format("{} at {:.2f} s", how_lost(loss.kind), at(recording, loss.last_good));
  const std::string gap =
      circumstances.slots < 2 ? "" : fmt::format(", over a gap of {} slots{}", circumstances.slots, gap_note);
  return fmt::format("{} at {:.2f}-{:.2f} s{}", how_lost(loss.kind), at(recording, loss.last_good),
                     at(recording, loss.first_lost), gap);
}

std::string end_text(const Recording& recording, const Loss& loss) {
  const double watched = seconds(loss_time(recording, loss));
  switch (loss.end) {
    case LossEnd::recovered:
      return fmt::format("recovered in {:.2f} s", watched);
    case LossEnd::chance:
      return fmt::format("the target came back to it by chance after {:.2f} s", watched);
    case LossEnd::target_left:
      return fmt::format("not recovered in the {:.2f} s before the target left", watched);
    case LossEnd::reset:
      return fmt::format("started again after {:.2f} s", watched);
    case LossEnd::labels_stopped:
      return fmt::format("not recovered in the {:.2f} s before labels stop", watched);
    case LossEnd::recording_stopped:
      break;
  }
  return fmt::format("not recovered in {:.2f} s", watched);
}

std::string gap_note(const Circumstances& c) {
  std::vector<std::string> parts;
  if (c.slots_recorded > 0) parts.push_back(fmt::format("{} recorded", c.slots_recorded));
  if (c.slots_injected > 0) parts.push_back(fmt::format("{} injected", c.slots_injected));
  if (c.slots_skipped > 0) parts.push_back(fmt::format("{} skipped", c.slots_skipped));
  return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", "));
}

std::string arrival_text(const Circumstances& c) {
  std::vector<std::string> parts;
  if (c.size_px) parts.push_back(fmt::format("{:.0f} px large", *c.size_px));
  if (c.blur_px) parts.push_back(fmt::format("blurred over {:.1f} px", *c.blur_px));
  if (c.displacement_d) parts.push_back(fmt::format("{:.2f} D from where it was before", *c.displacement_d));
  if (c.border_px)
    parts.push_back(*c.border_px >= 0 ? fmt::format("{:.0f} px from the border", *c.border_px)
                                      : fmt::format("{:.0f} px over the border", -*c.border_px));
  if (c.tilt_deg) parts.push_back(fmt::format("tilted by {:.0f} degrees", *c.tilt_deg));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string said_text(const Loss& loss) {
  const auto frames = [&](LossKind kind) { return loss.said[static_cast<std::size_t>(kind)]; };
  std::vector<std::string> parts;
  const auto add = [&](LossKind kind, std::string_view what) {
    const int n = frames(kind);
    if (n == 0) return;
    const std::string unit = !parts.empty() ? "" : n == 1 ? " frame" : " frames";
    parts.push_back(fmt::format("{} on {}{}", what, n, unit));
  };
  add(LossKind::Silent, "a wrong place");
  add(LossKind::WrongId, "another target");
  add(LossKind::Drift, "a place off its centre");
  add(LossKind::Declared, "nothing");
  return joined(parts);
}

}  // namespace relock
