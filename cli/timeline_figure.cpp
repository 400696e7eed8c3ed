#include "cli/timeline_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace relock {
namespace {

/// What a lane can show. Gaps stand in a lane of their own.
enum Kind : std::size_t {
  hit,
  stray,
  wrong_id,
  miss,
  false_alarm,
  correct_reject,
  given,
  skipped,
  unlabelled,
  not_recorded,
  dropped,
};

// Told apart by their shapes without any colour: a Hit fills the lane, what is wrong fills half of it, silence is a
// line at its foot. Colours are those of the terminal's lanes (eval/timeline_text.cpp).
struct KindLook {
  std::string name;
  LaneLook look;
};
const std::vector<KindLook>& all_kinds() {
  static const std::vector<KindLook> all{
      {"Hit", {"#009e73", -.40, .40}},        {"Stray", {"#d55e00", -.40, .05}},
      {"WrongId", {"#cc79a7", -.05, .40}},    {"Miss", {"#0072b2", -.40, -.26}},
      {"FalseAlarm", {"#e69f00", .16, .40}},  {"CorrectReject", {"#999999", -.05, .05}},
      {"Given", {"#000000", -.46, .46}},      {"Skipped", {"#56b4e9", -.40, -.34}},
      {"unlabelled", {"#dddddd", -.12, .12}}, {"not recorded", {"#000000", -.30, .30}},
      {"dropped", {"#808080", -.30, .05}},
  };
  return all;
}

std::optional<Kind> kind_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::NotStarted:
    case Verdict::Dropped:
      return {};
    case Verdict::Skipped:
      return skipped;
    case Verdict::Given:
      return given;
    case Verdict::Unlabelled:
      return unlabelled;
    case Verdict::Hit:
      return hit;
    case Verdict::WrongId:
      return wrong_id;
    case Verdict::Stray:
      return stray;
    case Verdict::Miss:
      return miss;
    case Verdict::FalseAlarm:
      return false_alarm;
    case Verdict::CorrectReject:
      break;
  }
  return correct_reject;
}

/// Where each frame is on the axis, s.
class Axis {
 public:
  explicit Axis(const Recording& recording) : recording_(recording) {}

  double from(std::size_t frame) const {
    return seconds(recording_.captured[frame] - recording_.captured.front());
  }
  /// To the next frame, or for one period where a gap follows.
  double to(std::size_t frame) const {
    return gap_after(frame) || frame + 1 == recording_.frames() ? from(frame) + seconds(recording_.period)
                                                                : from(frame + 1);
  }
  bool gap_after(std::size_t frame) const {
    return frame + 1 < recording_.frames() &&
           slots(recording_.captured[frame + 1] - recording_.captured[frame], recording_.period) >= 2;
  }

 private:
  const Recording& recording_;
};

PlotLane lane_of(const Recording& recording, const TargetTimeline& timeline, std::string name) {
  const Axis axis(recording);
  PlotLane lane{std::move(name), {}};
  for (std::size_t frame = 0; frame < recording.frames(); ++frame)
    if (const auto kind = kind_of(timeline.judgements[frame].verdict))
      lane.stretches.push_back({axis.from(frame), axis.to(frame), *kind});
  return lane;
}

/// Frames that never were, and frames that never came.
PlotLane lane_of_gaps(const Recording& recording, const Trajectory& trajectory) {
  const Axis axis(recording);
  PlotLane lane{"gaps", {}};
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    if (trajectory.frames[frame].delivery == Delivery::dropped)
      lane.stretches.push_back({axis.from(frame), axis.to(frame), dropped});
    if (axis.gap_after(frame)) lane.stretches.push_back({axis.to(frame), axis.from(frame + 1), not_recorded});
  }
  return lane;
}

std::vector<LaneBar> bars_of_blur(const Recording& recording, const std::vector<std::size_t>& targets) {
  const Axis axis(recording);
  std::vector<LaneBar> bars;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    std::optional<double> longest;
    for (const std::size_t target : targets)
      if (const auto& blur = recording.truth_of(frame, target).blur)
        longest = std::max(longest.value_or(0), norm(*blur));
    if (longest) bars.push_back({axis.from(frame), axis.to(frame), *longest});
  }
  return bars;
}

/// Leaves only the kinds that are there, in their order.
void keep_those_that_occur(LanePlot& plot) {
  std::set<std::size_t> there;
  for (const PlotLane& lane : plot.lanes)
    for (const LaneStretch& stretch : lane.stretches) there.insert(stretch.kind);
  for (const std::size_t kind : there) {
    plot.kinds.push_back(all_kinds()[kind].name);
    plot.looks.push_back(all_kinds()[kind].look);
  }
  for (PlotLane& lane : plot.lanes)
    for (LaneStretch& stretch : lane.stretches)
      stretch.kind = static_cast<std::size_t>(std::distance(there.begin(), there.find(stretch.kind)));
}

}  // namespace

std::optional<LaneLook> look_of(Verdict verdict) {
  const auto kind = kind_of(verdict);
  return kind ? std::optional(all_kinds()[*kind].look) : std::nullopt;
}

LanePlot timeline_figure(const ScoredComparison& compared, const std::vector<std::size_t>& runs,
                         const std::vector<std::size_t>& targets) {
  const StoredComparison& stored = compared.stored;
  const Recording& recording = stored.recording;
  LanePlot plot{.x = {"time [s]"}, .kinds = {}, .lanes = {}, .width_mm = kTwoColumns_mm, .lane_mm = 5.5};
  plot.above = bars_of_blur(recording, targets);
  plot.above_title = "blur [px]";
  PlotLane gaps = lane_of_gaps(recording, stored.runs[runs.front()].trajectory);
  if (!gaps.stretches.empty()) plot.lanes.push_back(std::move(gaps));
  for (const std::size_t target : targets)
    for (const std::size_t run : runs) {
      if (!stored.runs[run].trajectory.judged_from[target]) continue;
      const std::string& method = stored.runs[run].record.method;
      plot.lanes.push_back(lane_of(
          recording, compared.evaluations[run].targets[target],
          targets.size() == 1 ? method : fmt::format("{}: {}", recording.targets[target].id, method)));
    }
  keep_those_that_occur(plot);
  return plot;
}

}  // namespace relock
