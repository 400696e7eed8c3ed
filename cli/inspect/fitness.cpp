// What a recording is fit for: every rule of `relock inspect`, with its numbers.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/inspect/report.h"
#include "eval/definitions.h"
#include "eval/inspection/blur_estimate.h"

namespace relock {
namespace {

constexpr double kFollowUp_s = 5;        // the longest time that recovery is scored within
constexpr std::int64_t kTellingGap = 3;  // slots: shorter gaps hardly disturb a tracker
constexpr double kFewLabels = 0.5;       // share of frames
constexpr double kLongStep_d = 0.5;      // trackers search about one size around the last place
constexpr double kSmallTarget_px = 10;   // library trackers fail below it
constexpr double kHeavyBlur_d = 0.25;    // of the target's size: fine structure is gone
constexpr double kStaleLabels = 3;       // scored frames that make a loss
constexpr double kJitter = 0.2;          // of T

class Rules {
 public:
  explicit Rules(const InspectReport& report)
      : report_(report), recording_(report.sequence.recording), found_(report.inspection) {}

  std::vector<Remark> apply() {
    times();
    if (recording_.targets.empty()) {
      limit("no labels: nothing can be scored; detectors can be tried on single pictures (`relock detect`)");
    } else {
      length();
      visits();
      for (std::size_t t = 0; t < recording_.targets.size(); ++t) target(t);
    }
    std::stable_sort(remarks_.begin(), remarks_.end(),
                     [](const Remark& a, const Remark& b) { return a.kind < b.kind; });
    return std::move(remarks_);
  }

 private:
  template <class... Values>
  void fit(fmt::format_string<Values...> sentence, Values&&... values) {
    remarks_.push_back({Remark::Kind::fit, fmt::format(sentence, std::forward<Values>(values)...)});
  }
  template <class... Values>
  void limit(fmt::format_string<Values...> sentence, Values&&... values) {
    remarks_.push_back({Remark::Kind::limit, fmt::format(sentence, std::forward<Values>(values)...)});
  }
  const std::string& name(std::size_t t) const { return recording_.targets[t].id; }

  /// Names of the targets that `holds` is true of.
  template <class Holds>
  std::string those(Holds holds) const {
    std::vector<std::string> names;
    for (std::size_t t = 0; t < found_.targets.size(); ++t)
      if (holds(found_.targets[t])) names.push_back(name(t));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  void times() {
    const IntervalInspection& in = found_.intervals;
    if (recording_.frames() == 1) return limit("one frame: there is nothing to follow");
    if (report_.sequence.times_from != TimesFrom::recorded) {
      limit("times are from {}: gaps and jitter of the camera cannot be seen; inject gaps with --gaps",
            report_.sequence.times_from == TimesFrom::stated_rate ? "a stated rate" : "an assumed rate");
      return;
    }
    const auto longest = in.slots.empty() ? 1 : *std::max_element(in.slots.begin(), in.slots.end());
    if (longest >= kTellingGap) {
      fit("gaps as recorded: {} of {} intervals, up to {} slots", in.gaps, in.slots.size(), longest);
    } else {
      limit("no gap of {} slots or more: inject some with --gaps", kTellingGap);
    }
    const double period_ms = 1e3 * seconds(recording_.period);
    if (in.jitter && in.jitter->deviation_ms > kJitter * period_ms)
      limit("times jitter by {:.0f} % of T: slots may be miscounted",
            100 * in.jitter->deviation_ms / period_ms);
    if (!in.pauses.empty())
      limit("pauses of over {:.0f} s: {}; nothing is scored across them", seconds(kPause), in.pauses.size());
  }

  void length() {
    const auto enough = [](const TargetInspection& t) { return seconds(t.seen_for) >= kFollowUp_s; };
    if (const auto names = those([&](const auto& t) { return t.first_startable && enough(t); });
        !names.empty())
      fit("recovery within {:.0f} s: {}", kFollowUp_s, names);
    Duration longest{};
    for (const auto& t : found_.targets) longest = std::max(longest, t.seen_for);
    if (const auto names = those([&](const auto& t) { return t.first_startable && !enough(t); });
        !names.empty())
      limit(
          "too short to measure every recovery: {} from the first start to the last label at most {:.1f} s "
          "({:.0f} s of follow-up wanted)",
          names, seconds(longest), kFollowUp_s);
  }

  void visits() {
    const auto returns = those([](const auto& t) { return t.returns > 0; });
    if (!returns.empty()) fit("reacquiring after an absence: {}", returns);
    const auto absent = those([](const auto& t) { return t.absent > 0; });
    if (!absent.empty()) fit("false alarms while absent: {}", absent);
    const auto stays = those([](const auto& t) { return t.visible > 0 && t.absent == 0; });
    if (!stays.empty())
      limit("never labelled absent, so nothing is said of reacquiring or false alarms: {}", stays);
  }

  void target(std::size_t t) {
    const TargetInspection& in = found_.targets[t];
    if (in.visible == 0) return limit("{} is never visible: it cannot be scored", name(t));
    if (in.first_startable) {
      fit("trackers and detectors on {}: visible on {} frames, startable from frame {}", name(t), in.visible,
          *in.first_startable);
    } else {
      limit("{} is never whole in the picture and uncovered: trackers cannot be started on it", name(t));
    }
    labels(t, in);
    if (in.size_px->least < kSmallTarget_px)
      limit("{} is as small as {:.1f} px: library trackers cannot start below {:.0f} px", name(t),
            in.size_px->least, kSmallTarget_px);
    if (in.step_d && in.step_d->most >= kLongStep_d)
      limit(
          "{} steps up to {:.2f} of its size between frames (frame {}): trackers that search nearby lose it",
          name(t), in.step_d->most, in.step_d->most_at);
    blur(t, in);
  }

  void labels(std::size_t t, const TargetInspection& in) {
    const double share =
        static_cast<double>(in.visible + in.absent) / static_cast<double>(recording_.frames());
    if (share < kFewLabels && in.longest_unlabelled && *in.longest_unlabelled > kLabelsStop) {
      limit(
          "{} is labelled on {:.0f} % of the frames, up to {:.1f} s apart: beyond {:.1f} s losses and "
          "recoveries are cut off",
          name(t), 100 * share, seconds(*in.longest_unlabelled), seconds(kLabelsStop));
    } else if (share < kFewLabels) {
      limit("{} is labelled on {:.0f} % of the frames: losses shorter than about {:.2f} s cannot be seen",
            name(t), 100 * share, kStaleLabels * seconds(recording_.period) / share);
    }
    const double sigma = in.label_sigma_px->median;
    if (sigma > 0)
      limit("{}'s labels are good to {:g} px: localization finer than {:g} px is not shown", name(t), sigma,
            2 * sigma);
  }

  void blur(std::size_t t, const TargetInspection& in) {
    if (in.true_blur_px) {
      fit("exactness along and across the blur on {}: its labels state it, up to {:.1f} px", name(t),
          in.true_blur_px->most);
    }
    if (!report_.blur) return;
    const BlurSummary seen = summarise(report_.blur->targets[t]);
    if (seen.length_d && seen.length_d->p95 > kHeavyBlur_d)
      limit("{} is blurred by an estimated {:.1f} px, {:.2f} of its size (p95): fine structure is gone",
            name(t), seen.length_px->p95, seen.length_d->p95);
  }

  const InspectReport& report_;
  const Recording& recording_;
  const Inspection& found_;
  std::vector<Remark> remarks_;
};

}  // namespace

std::vector<Remark> remarks(const InspectReport& report) { return Rules(report).apply(); }

}  // namespace relock
