#include <fmt/format.h>

#include "cli/json_text.h"
#include "cli/scores/files.h"

namespace relock {
namespace {

template <std::size_t n>
Json bins(const std::array<HitCount, n>& counts, std::string_view (*name)(std::size_t)) {
  Json all;
  for (std::size_t bin = 0; bin < n; ++bin)
    all[std::string(name(bin))] = {{"could_hit", counts[bin].could_hit}, {"hits", counts[bin].hits}};
  return all;
}

Json to_json(const Recovery& r) {
  Json within;
  for (std::size_t i = 0; i < kRecoveredWithin_s.size(); ++i)
    within[fmt::format("{}_s", kRecoveredWithin_s[i])] = number(r.within[i]);
  return {{"losses", r.losses},       {"recovered", r.recovered},     {"median_s", number(r.median_s)},
          {"p90_s", number(r.p90_s)}, {"follow_up_s", r.follow_up_s}, {"probability_within", within}};
}

Json to_json(const TrackingSurvival& s, std::string_view claim) {
  return {{"median", number(s.median)},
          {"median_interval", interval(s.median_interval)},
          {fmt::format("at_{}", claim), number(s.at_claim)},
          {fmt::format("at_{}_interval", claim), interval(s.at_claim_interval)},
          {"follow_up", s.follow_up}};
}

Json to_json(const TrackingSurvivals& s) {
  return {{"starts", s.starts},
          {"losses", s.losses},
          {"frames", to_json(s.frames, fmt::format("{}_frames", kClaimFrames))},
          {"seconds", to_json(s.seconds, fmt::format("{}_s", kClaimSeconds))}};
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

Json to_json(const BlurAccuracy& b) {
  return {{"blurred", b.blurred},
          {"told", b.told},
          {"sharp", b.sharp},
          {"sharp_blurred", b.sharp_blurred},
          {"direction_median_deg", number(b.direction_median_deg)},
          {"direction_p95_deg", number(b.direction_p95_deg)},
          {"length_median_percent", number(b.length_median_percent)},
          {"length_p95_percent", number(b.length_p95_percent)}};
}

/// How many labels there are from where, and how many of them are not for this method.
Json labels_of(const Scores& s) {
  Json sources = Json::object();
  for (const auto& [source, count] : s.labels) sources[source.empty() ? "unstated" : source] = count;
  return {{"by_source", sources}, {"left_out_of_localization", s.own_labels}};
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
          {"f1", number(s.f1)},
          {"wrong_identity_rate", number(s.wrong_identity_rate)},
          {"false_alarms_per_1000", number(s.false_alarms_per_1000)},
          {"spurious_per_minute", number(s.spurious_per_minute)},
          {"visible_s", s.visible_s},
          {"locked_s", s.locked_s},
          {"lost_s", s.lost_s},
          {"searching_s", s.searching_s},
          {"availability", number(s.availability)},
          {"availability_ceiling", number(s.availability_ceiling)},
          {"availability_of_ceiling", number(s.availability_of_ceiling)},
          {"fix_age",
           {{"median_s", number(s.fix_age.median_s)},
            {"p95_s", number(s.fix_age.p95_s)},
            {"max_s", number(s.fix_age.max_s)}}},
          {"locked_share", number(s.locked_share)},
          {"locked_share_ceiling", number(s.locked_share_ceiling)},
          {"locked_share_of_ceiling", number(s.locked_share_of_ceiling)},
          {"losses", s.losses},
          {"losses_by_kind", kinds},
          {"losses_per_minute", number(s.losses_per_minute)},
          {"mean_time_between_losses_s", number(s.mean_time_between_losses_s)},
          {"silent_share", number(s.silent_share)},
          {"time_to_recover", to_json(s.recovery)},
          {"survival", to_json(s.survival)},
          {"localization", to_json(s.localization)},
          {"labels", labels_of(s)},
          {"blur", to_json(s.blur)},
          {"by_blur", bins(s.by_blur, blur_bin_name)},
          {"by_gap", bins(s.by_gap, gap_bin_name)}};
}

Json to_json(const RealTimeScores& s) {
  const auto lost = [&](LostTo cause) { return s.lost[static_cast<std::size_t>(cause)]; };
  const auto age = [&](double at) {
    return s.answer_age_s.empty() ? Json() : number(percentile(s.answer_age_s, at));
  };
  return {{"own_frames", s.own},
          {"own_hits", s.own_hits},
          {"delivered", s.delivered},
          {"skipped", s.skipped},
          {"in_force", s.in_force},
          {"hits", s.hits},
          {"lost_to_slowness", lost(LostTo::slowness)},
          {"lost_to_gaps", lost(LostTo::gaps)},
          {"lost_to_failure", lost(LostTo::failure)},
          {"answer_age_median_s", age(0.5)},
          {"answer_age_p95_s", age(0.95)}};
}

Json to_json(const Spread& s) { return {{"median", s.median_ms}, {"p95", s.p95_ms}, {"max", s.max_ms}}; }

Json to_json(const std::optional<Cost>& cost) {
  if (!cost) return {};
  return {{"frames", cost->frames},
          {"wall_ms", to_json(cost->wall)},
          {"cpu_ms", to_json(cost->cpu)},
          {"peak_bytes", cost->peak_bytes}};
}

Json to_json(const MethodPool& pool, const JudgedMethod& method) {
  Json intervals, standings;
  for (std::size_t i = 0; i < kShareScores; ++i) {
    const std::string name(share_scores()[i].name);
    intervals[name] = interval(method.shares[i]);
    standings[name] = to_string(method.standings[i]);
  }
  intervals["losses_per_minute"] = interval(method.losses_per_minute);
  intervals["time_to_recover_median_s"] = interval(method.scores.recovery.median_s_interval);
  intervals["median_px"] = interval(method.median_px);
  return {{"method", pool.method},
          {"yardstick", pool.yardstick},
          {"recordings", pool.frames.size()},
          {"scores", to_json(method.scores)},
          {"common", to_json(method.common)},
          {"real_time", pool.real_time.in_force > 0 ? to_json(pool.real_time) : Json()},
          {"cost", to_json(method.cost)},
          {"intervals", intervals},
          {"standings", standings}};
}

Json to_json(const JudgedTable& judged) {
  const ScoreTable& table = judged.table;
  Json methods = Json::array();
  for (std::size_t i = 0; i < judged.methods.size(); ++i)
    methods.push_back(to_json(table.methods[i], judged.methods[i]));
  return {{"protocol", table.conditions.protocol},
          {"gaps", table.conditions.gaps},
          {"gate", table.conditions.gate},
          {"real_time", table.conditions.real_time},
          {"latency", table.conditions.latency},
          {"recordings", table.recordings},
          {"seeds", table.seeds},
          {"starts", table.starts},
          {"by", to_string(table.grouping)},
          {"group", table.group},
          {"methods", methods}};
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
  return json_text(json);
}

std::string tables_json(const std::vector<JudgedTable>& tables) {
  Json all = Json::array();
  for (const JudgedTable& table : tables) all.push_back(to_json(table));
  return json_text({{"tables", all}});
}

}  // namespace relock
