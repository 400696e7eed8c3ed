// The report of `relock inspect` as JSON.

#include "cli/inspect/report.h"
#include "cli/json_text.h"
#include "eval/inspection/blur_estimate.h"

namespace relock {
namespace {

template <class Value>
Json maybe(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json maybe(const std::optional<Spread>& s) {
  if (!s) return {};
  return {{"least", s->least},
          {"median", s->median},
          {"p95", s->p95},
          {"most", s->most},
          {"most_at_frame", s->most_at}};
}

Json to_json(const Recording& recording, const IntervalInspection& in) {
  Json histogram = Json::array(), intervals = Json::array();
  for (std::size_t i = 0; i < kSlotBins.size(); ++i)
    histogram.push_back({{"from_slots", kSlotBins[i].from},
                         {"to_slots", kSlotBins[i].to == INT64_MAX ? Json() : Json(kSlotBins[i].to)},
                         {"intervals", in.histogram[i]}});
  for (std::size_t i = 1; i < recording.frames(); ++i)
    intervals.push_back((recording.captured[i] - recording.captured[i - 1]).count());
  Json longest, jitter;
  if (in.longest_gap_before) {
    const auto end = static_cast<std::size_t>(*in.longest_gap_before);
    longest = {{"slots", in.slots[end - 1]},
               {"duration_s", seconds(recording.captured[end] - recording.captured[end - 1])},
               {"before_frame", end}};
  }
  if (in.jitter)
    jitter = {{"intervals", in.jitter->intervals},
              {"deviation_ms", in.jitter->deviation_ms},
              {"largest_ms", in.jitter->largest_ms},
              {"largest_before_frame", in.jitter->largest_at}};
  return {{"histogram", histogram}, {"gaps", in.gaps},          {"missing_share", number(in.missing_share)},
          {"longest_gap", longest}, {"jitter", jitter},         {"pauses_before_frame", in.pauses},
          {"slots", in.slots},      {"intervals_ns", intervals}};
}

Json to_json(const std::vector<BlurOfFrame>& frames) {
  const BlurSummary s = summarise(frames);
  Json each = Json::array();
  for (const BlurOfFrame& f : frames)
    each.push_back(
        {{"frame", f.frame},
         {"length_px", f.blur ? Json(f.blur->length_px) : Json()},
         {"direction_rad", f.blur && f.blur->length_px > 0 ? Json(f.blur->direction_rad) : Json()}});
  return {{"frames_measured", s.measured},   {"frames_below", s.below},       {"frames_declined", s.declined},
          {"length_px", maybe(s.length_px)}, {"length_d", maybe(s.length_d)}, {"frames", each}};
}

Json to_json(const InspectReport& report, std::size_t t) {
  const TargetInspection& in = report.inspection.targets[t];
  return {{"id", report.sequence.recording.targets[t].id},
          {"visible_frames", in.visible},
          {"absent_frames", in.absent},
          {"unlabelled_frames", in.unlabelled},
          {"first_startable_frame", maybe(in.first_startable)},
          {"seen_for_s", seconds(in.seen_for)},
          {"longest_unlabelled_s", in.longest_unlabelled ? Json(seconds(*in.longest_unlabelled)) : Json()},
          {"departures", in.departures},
          {"returns", in.returns},
          {"label_sigma_px", maybe(in.label_sigma_px)},
          {"size_px", maybe(in.size_px)},
          {"step_d", maybe(in.step_d)},
          {"true_blur_px", maybe(in.true_blur_px)},
          {"estimated_blur", report.blur ? to_json(report.blur->targets[t]) : Json()}};
}

}  // namespace

std::string inspect_json(const InspectReport& report) {
  const Recording& recording = report.sequence.recording;
  Json targets = Json::array(), fit = Json::array(), limits = Json::array();
  for (std::size_t t = 0; t < recording.targets.size(); ++t) targets.push_back(to_json(report, t));
  for (const Remark& remark : remarks(report))
    (remark.kind == Remark::Kind::fit ? fit : limits).push_back(remark.sentence);
  const Json json{{"recording", recording.name},
                  {"format", report.sequence.format},
                  {"times_from", to_string(report.sequence.times_from)},
                  {"frames", recording.frames()},
                  {"width_px", recording.picture.width},
                  {"height_px", recording.picture.height},
                  {"duration_s", seconds(recording.captured.back() - recording.captured.front())},
                  {"period_ns", recording.period.count()},
                  {"period_stated", report.sequence.period_stated},
                  {"median_interval_ns", report.sequence.median_interval.count()},
                  {"intervals", to_json(recording, report.inspection.intervals)},
                  {"targets", targets},
                  {"picture_blur", report.blur ? to_json(report.blur->picture) : Json()},
                  {"blur_estimator",
                   {{"model", "line blur; Whittle likelihood, spectrum a product of frequency and direction"},
                    {"least_px", kLeastBlur_px},
                    {"most_px", kMostBlur_px}}},
                  {"pictures_fault", maybe(report.pictures_fault)},
                  {"fit_for", fit},
                  {"limits", limits}};
  return json_text(json);
}

}  // namespace relock
