#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "tests/eval/naive_evaluator.h"
#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t kSeeds = 500;  // ten times as slow
#else
constexpr std::uint64_t kSeeds = 10000;
#endif
constexpr int kEnough = 10;  // disagreements told before the test gives up

// --- Readable timelines.

std::string verdict_line(const TargetTimeline& target) {
  std::string line;
  for (const Judgement& j : target.judgements) {
    const bool held = j.verdict == Verdict::Stray && j.hold;
    line += held ? 's' : " .-g?HWSMFr"[static_cast<std::size_t>(j.verdict)];
  }
  return line;
}
std::string state_line(const TargetTimeline& target) {
  std::string line;
  for (const State s : target.states) line += " sLxo"[static_cast<std::size_t>(s)];
  return line;
}
std::string label_line(const Recording& recording, std::size_t target) {
  std::string line;
  for (std::size_t k = 0; k < recording.captured.size(); ++k)
    line += "?vr"[static_cast<std::size_t>(recording.truth_of(k, target).label)];
  return line;
}
// Slots to the next frame: '|' is a pause.
std::string gap_line(const Recording& recording) {
  std::string line;
  for (std::size_t k = 0; k + 1 < recording.captured.size(); ++k) {
    const Duration step = recording.captured[k + 1] - recording.captured[k];
    const auto slots = std::min<std::int64_t>(9, (step + recording.period / 2) / recording.period);
    line += step > std::chrono::seconds(5) ? '|' : slots == 1 ? ' ' : static_cast<char>('0' + slots);
  }
  return line;
}
void tell(std::ostream& out, const Loss& l) {
  out << "loss by rule "
      << "ab"[static_cast<int>(l.rule)] << " kind " << static_cast<int>(l.kind) << " good " << l.last_good
      << " lost " << l.first_lost << " declared " << l.declared << " end " << static_cast<int>(l.end)
      << " at " << l.end_frame << " said";
  for (const int n : l.said) out << ' ' << n;
}
void tell(std::ostream& out, const Acquisition& a) {
  out << "search " << static_cast<int>(a.kind) << " from " << a.from << " locked at "
      << a.locked_at.value_or(-1);
}
void tell(std::ostream& out, const Judgement& j) {
  out << "verdict " << static_cast<int>(j.verdict) << " hold " << j.hold << " uncoded " << j.uncoded
      << " failed " << j.failed << " sighting " << j.sighting << " error " << j.error_px;
}

// --- Comparison: what differs, one line each; empty when they agree.

template <class T>
std::string first_difference(const std::string& what, const std::vector<T>& ours,
                             const std::vector<T>& naive) {
  for (std::size_t i = 0; i < std::max(ours.size(), naive.size()); ++i) {
    if (i < ours.size() && i < naive.size() && ours[i] == naive[i]) continue;
    std::ostringstream out;
    out << what << ' ' << i << ":\n    eval  ";
    if (i < ours.size()) tell(out, ours[i]);
    out << "\n    naive ";
    if (i < naive.size()) tell(out, naive[i]);
    return out.str() + '\n';
  }
  return {};
}

bool nearly_equal(double a, double b) {
  if (a == b) return true;  // infinite equals infinite, and nothing else
  if (!std::isfinite(a) || !std::isfinite(b)) return false;
  return std::abs(a - b) <= 1e-9 * std::max({std::abs(a), std::abs(b), 1e-3});
}

// The same judgement, errors to the last digits but one.
std::vector<Judgement> rounded(std::vector<Judgement> judgements, const std::vector<Judgement>& others) {
  for (std::size_t k = 0; k < std::min(judgements.size(), others.size()); ++k)
    if (nearly_equal(judgements[k].error_px, others[k].error_px)) judgements[k].error_px = others[k].error_px;
  return judgements;
}

std::string difference(const Evaluation& ours, const Evaluation& naive, const Recording& recording) {
  std::ostringstream out;
  if (ours.spurious != naive.spurious) {
    const auto at = std::mismatch(ours.spurious.begin(), ours.spurious.end(), naive.spurious.begin(),
                                  naive.spurious.end());
    out << "  spurious differ on frame " << at.first - ours.spurious.begin() << ": eval " << *at.first
        << ", naive " << *at.second << '\n';
  }
  if (ours.ignored != naive.ignored) {
    const auto at =
        std::mismatch(ours.ignored.begin(), ours.ignored.end(), naive.ignored.begin(), naive.ignored.end());
    out << "  ignored differ on frame " << at.first - ours.ignored.begin() << ": eval " << *at.first
        << ", naive " << *at.second << '\n';
  }
  if (ours.targets.size() != naive.targets.size()) return "  number of targets\n";
  for (std::size_t t = 0; t < naive.targets.size(); ++t) {
    const TargetTimeline &a = ours.targets[t], &b = naive.targets[t];
    std::string told =
        first_difference("  judgement of frame", rounded(a.judgements, b.judgements), b.judgements) +
        first_difference("  loss", a.losses, b.losses) +
        first_difference("  acquisition", a.acquisitions, b.acquisitions);
    if (a.states != b.states) {
      const auto at = std::mismatch(a.states.begin(), a.states.end(), b.states.begin(), b.states.end());
      told += "  state of frame " + std::to_string(at.first - a.states.begin()) + '\n';
    }
    if (told.empty()) continue;
    out << "target " << t << ":\n"
        << told << "  slots  " << gap_line(recording) << "\n  labels " << label_line(recording, t)
        << "\n  eval   " << verdict_line(a) << "\n         " << state_line(a) << "\n  naive  "
        << verdict_line(b) << "\n         " << state_line(b) << '\n';
  }
  return out.str();
}

using Fields = std::vector<std::pair<std::string, std::optional<double>>>;

constexpr const char* kSources[] = {"", "hand", "spline", "detector ring", "spline detector kcf+ring"};

std::size_t labels_from(const Scores& s, const std::string& source) {
  const auto found = s.labels.find(source);
  return found == s.labels.end() ? 0 : found->second;
}

Fields fields(const Scores& s) {
  Fields all;
  const auto add = [&](std::string name, std::optional<double> value) {
    all.emplace_back(std::move(name), value);
  };
  const auto add_count = [&](std::string name, auto value) {
    add(std::move(name), static_cast<double>(value));
  };
  for (std::size_t i = 0; i < kVerdicts; ++i) add_count("verdicts " + std::to_string(i), s.verdicts[i]);
  add_count("frames", s.frames), add_count("uncoded", s.uncoded), add_count("failed", s.failed);
  add_count("spurious", s.spurious), add_count("ignored", s.ignored);
  add("recognition", s.recognition), add("precision", s.precision), add("f1", s.f1);
  add("wrong_identity_rate", s.wrong_identity_rate);
  add("false_alarms_per_1000", s.false_alarms_per_1000), add("spurious_per_minute", s.spurious_per_minute);
  add("visible_s", s.visible_s), add("locked_s", s.locked_s), add("lost_s", s.lost_s);
  add("searching_s", s.searching_s);
  add("availability", s.availability), add("availability_ceiling", s.availability_ceiling);
  add("availability_of_ceiling", s.availability_of_ceiling);
  add("fix_age.median_s", s.fix_age.median_s), add("fix_age.p95_s", s.fix_age.p95_s);
  add("fix_age.max_s", s.fix_age.max_s);
  add("locked_share", s.locked_share), add("locked_share_ceiling", s.locked_share_ceiling);
  add("locked_share_of_ceiling", s.locked_share_of_ceiling);
  add_count("losses", s.losses);
  for (std::size_t i = 0; i < kLossKinds; ++i)
    add_count("losses_by_kind " + std::to_string(i), s.losses_by_kind[i]);
  add("losses_per_minute", s.losses_per_minute),
      add("mean_time_between_losses_s", s.mean_time_between_losses_s);
  add("silent_share", s.silent_share);
  for (std::size_t i = 0; i < kBlurBinCount; ++i) {
    add_count("by_blur could_hit " + std::to_string(i), s.by_blur[i].could_hit);
    add_count("by_blur hits " + std::to_string(i), s.by_blur[i].hits);
  }
  for (std::size_t i = 0; i < kGapBinCount; ++i) {
    add_count("by_gap could_hit " + std::to_string(i), s.by_gap[i].could_hit);
    add_count("by_gap hits " + std::to_string(i), s.by_gap[i].hits);
  }
  const Recovery& r = s.recovery;
  add_count("recovery.losses", r.losses), add_count("recovery.recovered", r.recovered);
  add("recovery.median_s", r.median_s), add("recovery.p90_s", r.p90_s),
      add("recovery.follow_up_s", r.follow_up_s);
  for (std::size_t i = 0; i < r.within.size(); ++i) add("recovery.within " + std::to_string(i), r.within[i]);
  const Localization& l = s.localization;
  add_count("localization.hits", l.hits);
  add("mean_px", l.mean_px), add("rms_px", l.rms_px), add("median_px", l.median_px), add("p95_px", l.p95_px);
  add("mean_percent", l.mean_percent), add("rms_percent", l.rms_percent);
  add("median_percent", l.median_percent), add("p95_percent", l.p95_percent);
  add("bias_px.x", l.bias_px ? std::optional(l.bias_px->x) : std::nullopt);
  add("bias_px.y", l.bias_px ? std::optional(l.bias_px->y) : std::nullopt);
  add("spread_px", l.spread_px), add("along_blur_px", l.along_blur_px),
      add("across_blur_px", l.across_blur_px);
  add("label_sigma_px", l.label_sigma_px);
  add_count("own_labels", s.own_labels);
  for (const char* source : kSources) add_count(std::string("labels ") + source, labels_from(s, source));
  for (std::size_t i = 0; i < l.within.size(); ++i)
    add("localization.within " + std::to_string(i), l.within[i]);
  const BlurAccuracy& b = s.blur;
  add_count("blurred", b.blurred), add_count("told", b.told);
  add_count("sharp", b.sharp), add_count("sharp_blurred", b.sharp_blurred);
  add("direction_median_deg", b.direction_median_deg), add("direction_p95_deg", b.direction_p95_deg);
  add("length_median_percent", b.length_median_percent), add("length_p95_percent", b.length_p95_percent);
  return all;
}

std::string difference(const std::string& whose, const Scores& ours, const Scores& naive) {
  std::ostringstream out;
  const auto show = [](const std::optional<double>& v) {
    return v ? testing::PrintToString(*v) : std::string("n/a");
  };
  const Fields a = fields(ours), b = fields(naive);
  for (std::size_t i = 0; i < b.size(); ++i) {
    const auto &x = a[i].second, &y = b[i].second;
    if (x.has_value() == y.has_value() && (!x || nearly_equal(*x, *y))) continue;
    out << "  " << whose << ' ' << b[i].first << ": eval " << show(x) << ", naive " << show(y) << '\n';
  }
  return out.str();
}

std::string difference(const Case& drawn, const Gate& gate) {
  const auto& [recording, trajectory] = drawn;
  const Evaluation ours = relock::evaluate(recording, trajectory, gate);
  const Evaluation naive = naive::evaluate(recording, trajectory, gate);
  const std::string events = difference(ours, naive, recording);
  if (!events.empty()) return events;
  const ScoreSheet our_scores = relock::score(recording, trajectory, ours);
  const ScoreSheet naive_scores = naive::score(recording, trajectory, naive);
  std::string scores = difference("pooled", our_scores.pooled, naive_scores.pooled);
  for (std::size_t t = 0; t < naive_scores.targets.size(); ++t)
    scores += difference("target " + std::to_string(t), our_scores.targets.at(t), naive_scores.targets[t]);
  if (scores.empty()) return {};
  for (std::size_t t = 0; t < naive.targets.size(); ++t)
    scores += "  slots   " + gap_line(recording) + "\n  labels  " + label_line(recording, t) +
              "\n  verdict " + verdict_line(naive.targets[t]) + "\n  state   " +
              state_line(naive.targets[t]) + '\n';
  return scores;
}

void expect_agreement(const Gate& gate) {
  int told = 0;
  for (std::uint64_t seed = 0; seed < kSeeds && told < kEnough; ++seed) {
    const std::string differs = difference(random_case(seed), gate);
    if (differs.empty()) continue;
    ++told;
    ADD_FAILURE() << "seed " << seed << '\n' << differs;
  }
}

TEST(Evaluators, AgreeOnRandomTimelinesJudgedByPosition) { expect_agreement(Gate{}); }
TEST(Evaluators, AgreeOnRandomTimelinesJudgedStrictly) {
  expect_agreement(Gate{.measure = Gate::Measure::centre, .hit = 0.1, .hold = 0.375});
}
TEST(Evaluators, AgreeOnRandomTimelinesJudgedByOverlap) { expect_agreement(Gate::iou()); }

}  // namespace
}  // namespace relock
