#include "cli/score_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace relock {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const Recovery& r) {
  Json within;
  for (std::size_t i = 0; i < kRecoveredWithin_s.size(); ++i)
    within[fmt::format("{}_s", kRecoveredWithin_s[i])] = number(r.within[i]);
  return {{"losses", r.losses},       {"recovered", r.recovered},     {"median_s", number(r.median_s)},
          {"p90_s", number(r.p90_s)}, {"follow_up_s", r.follow_up_s}, {"probability_within", within}};
}

Json to_json(const Localization& l) {
  Json within;
  for (std::size_t i = 0; i < kWithinD.size(); ++i)
    within[fmt::format("{}_d", kWithinD[i])] = number(l.within[i]);
  return {{"hits", l.hits},
          {"mean_px", number(l.mean_px)},
          {"rms_px", number(l.rms_px)},
          {"median_px", number(l.median_px)},
          {"p95_px", number(l.p95_px)},
          {"mean_percent_d", number(l.mean_percent)},
          {"rms_percent_d", number(l.rms_percent)},
          {"median_percent_d", number(l.median_percent)},
          {"p95_percent_d", number(l.p95_percent)},
          {"bias_px", l.bias_px ? Json{l.bias_px->x, l.bias_px->y} : Json()},
          {"spread_px", number(l.spread_px)},
          {"along_blur_px", number(l.along_blur_px)},
          {"across_blur_px", number(l.across_blur_px)},
          {"label_sigma_px", number(l.label_sigma_px)},
          {"share_within", within}};
}

Json to_json(const Scores& s) {
  Json verdicts, kinds;
  for (std::size_t v = 0; v < kVerdicts; ++v)
    verdicts[std::string(to_string(static_cast<Verdict>(v)))] = s.verdicts[v];
  for (std::size_t k = 0; k < kLossKinds; ++k)
    kinds[std::string(to_string(static_cast<LossKind>(k)))] = s.losses_by_kind[k];
  return {{"frames", s.frames},
          {"verdicts", verdicts},
          {"uncoded", s.uncoded},
          {"failed", s.failed},
          {"spurious", s.spurious},
          {"ignored", s.ignored},
          {"recognition", number(s.recognition)},
          {"precision", number(s.precision)},
          {"visible_s", s.visible_s},
          {"locked_s", s.locked_s},
          {"lost_s", s.lost_s},
          {"searching_s", s.searching_s},
          {"availability", number(s.availability)},
          {"availability_ceiling", number(s.availability_ceiling)},
          {"availability_of_ceiling", number(s.availability_of_ceiling)},
          {"locked_share", number(s.locked_share)},
          {"locked_share_ceiling", number(s.locked_share_ceiling)},
          {"locked_share_of_ceiling", number(s.locked_share_of_ceiling)},
          {"losses", s.losses},
          {"losses_by_kind", kinds},
          {"losses_per_minute", number(s.losses_per_minute)},
          {"mean_time_between_losses_s", number(s.mean_time_between_losses_s)},
          {"time_to_recover", to_json(s.recovery)},
          {"localization", to_json(s.localization)}};
}

}  // namespace

std::string scores_json(const StoredRun& run, const Recording& recording, const Gate& gate,
                        const ScoreSheet& sheet) {
  Json targets;
  for (std::size_t t = 0; t < recording.targets.size(); ++t)
    if (run.trajectory.judged_from[t]) targets[recording.targets[t].id] = to_json(sheet.targets[t]);
  const Json json{{"recording", recording.name},
                  {"method", run.record.method},
                  {"gaps", run.record.gaps},
                  {"seed", run.record.seed},
                  {"protocol", to_string(run.record.protocol)},
                  {"gate", to_string(gate)},
                  {"period_ns", recording.period.count()},
                  {"cut_short_at_frame", run.record.cut_short ? Json(run.record.cut_short->frame) : Json()},
                  {"pooled", to_json(sheet.pooled)},
                  {"targets", targets}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_array(const std::vector<std::string>& objects) {
  Json all = Json::array();
  for (const std::string& object : objects) all.push_back(Json::parse(object));
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace relock
