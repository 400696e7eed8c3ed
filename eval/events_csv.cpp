#include "eval/events_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/csv.h"
#include "eval/judgement/circumstances.h"

namespace relock {
namespace {

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.4f}", *value) : ""; }

struct Row {
  FrameIndex begin;
  std::string text;
};

class EventRows {
 public:
  EventRows(const Recording& recording, const Trajectory& trajectory, std::size_t target)
      : recording_(recording), trajectory_(trajectory), target_(target) {}

  Row row(const Loss& loss) const {
    const Circumstances c = circumstances(recording_, trajectory_, target_, loss);
    return {loss.last_good,
            fmt::format(
                "loss,{},{:.9f},{:.9f},{:.9f},{:.9f},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", id(),
                at(loss.last_good), at(loss.first_lost), at(loss.end_frame),
                at(loss.end_frame) - at(loss.last_good), loss.rule == LossRule::a ? "a" : "b",
                to_string(loss.kind), to_string(loss.end), loss.last_good, loss.first_lost, loss.declared,
                loss.end_frame, c.slots, c.slots_recorded, c.slots_injected, c.slots_skipped, cell(c.blur_px),
                cell(c.displacement_d), cell(c.border_px), cell(c.tilt_deg), cell(c.size_px))};
  }

  Row row(const Acquisition& search) const {
    const auto end = search.locked_at;
    return {search.from,
            fmt::format("{},{},{:.9f},,{},{},,,{},{},,,{},,,,,,,,,\n", to_string(search.kind), id(),
                        at(search.from), end ? fmt::format("{:.9f}", at(*end)) : "",
                        end ? fmt::format("{:.9f}", at(*end) - at(search.from)) : "",
                        end ? "locked" : "nothing", search.from, end ? std::to_string(*end) : "")};
  }

 private:
  std::string id() const { return csv_cell(recording_.targets[target_].id); }
  double at(FrameIndex frame) const {
    return seconds(recording_.captured[static_cast<std::size_t>(frame)] - recording_.captured.front());
  }

  const Recording& recording_;
  const Trajectory& trajectory_;
  std::size_t target_;
};

}  // namespace

void write_events(std::ostream& out, const Recording& recording, const Trajectory& trajectory,
                  const Evaluation& evaluation) {
  out << "event,target,begin_s,begin_late_s,end_s,duration_s,rule,kind,ended_by,begin_frame,first_lost_frame,"
         "declared_frame,end_frame,slots,slots_recorded,slots_injected,slots_skipped,blur_px,displacement_d,"
         "border_px,tilt_deg,size_px\n";
  std::vector<Row> rows;
  for (std::size_t t = 0; t < recording.targets.size(); ++t) {
    const EventRows make(recording, trajectory, t);
    for (const Loss& loss : evaluation.targets[t].losses) rows.push_back(make.row(loss));
    for (const Acquisition& search : evaluation.targets[t].acquisitions) rows.push_back(make.row(search));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.begin < b.begin; });
  for (const Row& row : rows) out << row.text;
}

void write_verdicts(std::ostream& out, const Recording& recording, const Evaluation& evaluation) {
  out << "frame,target,verdict,state,error_px\n";
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    for (std::size_t t = 0; t < recording.targets.size(); ++t) {
      const Judgement& judged = evaluation.targets[t].judgements[frame];
      out << fmt::format("{},{},{},{},{}\n", frame, csv_cell(recording.targets[t].id),
                         to_string(judged.verdict), to_string(evaluation.targets[t].states[frame]),
                         std::isnan(judged.error_px) ? "" : fmt::format("{:.4f}", judged.error_px));
    }
  }
}

}  // namespace relock
