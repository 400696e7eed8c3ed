// The report of `relock inspect` as text.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/inspect/report.h"
#include "cli/table.h"
#include "eval/definitions.h"
#include "eval/inspection/blur_estimate.h"

namespace relock {
namespace {

constexpr double kBar = 40;  // characters of the longest bar

std::string number(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

std::string heading(const Sequence& s) {
  const Recording& r = s.recording;
  std::string text =
      fmt::format("{}: {} frame{} of {}x{}, {:.2f} s\n  format {}, times {}; T {:.3f} ms, {:.3f} Hz, {}",
                  r.name, r.frames(), r.frames() == 1 ? "" : "s", r.picture.width, r.picture.height,
                  seconds(r.captured.back() - r.captured.front()), s.format,
                  s.times_from == TimesFrom::recorded
                      ? "as recorded"
                      : fmt::format("from {} {}", s.times_from == TimesFrom::assumed_rate ? "an" : "a",
                                    to_string(s.times_from)),
                  1e3 * seconds(r.period), 1 / seconds(r.period), s.period_stated ? "stated" : "found");
  if (5 * std::chrono::abs(s.median_interval - r.period) > r.period)  // metrics.md section 2
    text += fmt::format(" (median interval {:.3f} ms)", 1e3 * seconds(s.median_interval));
  return text + "\n";
}

std::string label(const SlotBin& bin) {
  if (bin.from == bin.to) return std::to_string(bin.from);
  return bin.to == INT64_MAX ? fmt::format("{}+", bin.from) : fmt::format("{}-{}", bin.from, bin.to);
}

std::string histogram(const IntervalInspection& in) {
  const auto most = *std::max_element(in.histogram.begin(), in.histogram.end());
  std::string text;
  for (std::size_t i = 0; i < in.histogram.size(); ++i) {
    if (in.histogram[i] == 0) continue;
    const double share = static_cast<double>(in.histogram[i]) / static_cast<double>(most);
    const auto bar = static_cast<std::size_t>(std::max(1.0, std::round(kBar * share)));
    text += fmt::format("  {:>6} {:>7}  {}\n", label(kSlotBins[i]), in.histogram[i], std::string(bar, '#'));
  }
  return text;
}

std::string gaps(const Recording& r, const IntervalInspection& in) {
  if (!in.longest_gap_before) return "  no gaps\n";
  const auto end = static_cast<std::size_t>(*in.longest_gap_before);
  std::string text = fmt::format(
      "  {} gap{}; {} of all slots missing; the longest is {} slots, {:.3f} s, before frame {} at {:.3f} s\n",
      in.gaps, in.gaps == 1 ? "" : "s",
      in.missing_share ? fmt::format("{:.1f} %", 100 * *in.missing_share) : "n/a", in.slots[end - 1],
      seconds(r.captured[end] - r.captured[end - 1]), end, seconds(r.captured[end] - r.captured.front()));
  if (!in.pauses.empty())
    text += fmt::format(
        "  {} pause{} of over {:.0f} s, before frame {}; their slots are not counted as missing\n",
        in.pauses.size(), in.pauses.size() == 1 ? "" : "s", seconds(kPause), fmt::join(in.pauses, ", "));
  return text;
}

std::string intervals(const Recording& r, const IntervalInspection& in) {
  if (in.slots.empty()) return "";
  std::string text = "\nintervals, slots of T and how many\n" + histogram(in) + gaps(r, in);
  if (in.jitter) {
    const double percent = 100 / (1e3 * seconds(r.period));
    text += fmt::format(
        "  jitter of {} intervals of one slot: deviation {:.3f} ms, {:.1f} % of T; largest {:+.3f} ms, "
        "{:+.1f} %, before "
        "frame {}\n",
        in.jitter->intervals, in.jitter->deviation_ms, percent * in.jitter->deviation_ms,
        in.jitter->largest_ms, percent * in.jitter->largest_ms, in.jitter->largest_at);
  }
  return text;
}

std::string targets(const InspectReport& report) {
  const auto& all = report.inspection.targets;
  if (all.empty()) return "\nno targets: there are no labels\n";
  Table counts({"target", "visible", "absent", "unlabelled", "startable", "leaves", "returns", "sigma px"});
  Table sizes({"", "D px, least", "median", "most", "step D, median", "p95", "most", "at frame"});
  for (std::size_t t = 0; t < all.size(); ++t) {
    const TargetInspection& in = all[t];
    const std::string& name = report.sequence.recording.targets[t].id;
    counts.add({name, std::to_string(in.visible), std::to_string(in.absent), std::to_string(in.unlabelled),
                in.first_startable ? fmt::format("{}", *in.first_startable) : "never",
                std::to_string(in.departures), std::to_string(in.returns),
                in.label_sigma_px ? fmt::format("{:g}", in.label_sigma_px->median) : "n/a"});
    std::vector<std::string> row{name};
    for (const auto value : {&Spread::least, &Spread::median, &Spread::most})
      row.push_back(in.size_px ? number((*in.size_px).*value, 1) : "n/a");
    for (const auto value : {&Spread::median, &Spread::p95, &Spread::most})
      row.push_back(in.step_d ? number((*in.step_d).*value, 3) : "n/a");
    row.push_back(in.step_d ? fmt::format("{}", in.step_d->most_at) : "n/a");
    sizes.add(row);
  }
  return "\nlabels, frames\n" + counts.text(2) + "\nsizes, and steps from frame to frame\n" + sizes.text(2);
}

std::string blur_cell(double px) {
  return px < kLeastBlur_px ? "<" + number(kLeastBlur_px, 0) : number(px, 1);
}

void add_estimate(Table& table, const std::string& name, const std::vector<BlurOfFrame>& frames) {
  const BlurSummary s = summarise(frames);
  std::vector<std::string> row{name, std::to_string(s.measured), std::to_string(s.below),
                               std::to_string(s.declined)};
  for (const auto value : {&Spread::median, &Spread::p95, &Spread::most})
    row.push_back(s.length_px ? blur_cell((*s.length_px).*value) : "n/a");
  row.push_back(s.length_d ? number(s.length_d->p95, 2) : "n/a");
  row.push_back(s.length_px && s.measured > 0 ? fmt::format("{}", s.length_px->most_at) : "n/a");
  table.add(row);
}

std::string blur(const InspectReport& report) {
  std::string text;
  if (report.blur) {
    Table table(
        {"estimated", "measured", "below", "declined", "median px", "p95", "most", "p95 D", "at frame"});
    add_estimate(table, "picture", report.blur->picture);
    for (std::size_t t = 0; t < report.blur->targets.size(); ++t)
      add_estimate(table, report.sequence.recording.targets[t].id, report.blur->targets[t]);
    text += "\nmotion blur, frames and lengths\n" + table.text(2);
  }
  Table truth({"true, of the labels", "median px", "p95", "most", "at frame"});
  bool any = false;
  for (std::size_t t = 0; t < report.inspection.targets.size(); ++t) {
    const auto& px = report.inspection.targets[t].true_blur_px;
    if (!px) continue;
    any = true;
    truth.add({report.sequence.recording.targets[t].id, number(px->median, 1), number(px->p95, 1),
               number(px->most, 1), fmt::format("{}", px->most_at)});
  }
  if (any) text += (report.blur ? "" : "\nmotion blur\n") + truth.text(2);
  if (report.blur)
    text += fmt::format(
        "  Estimated from the pictures alone: a line blur times any spectrum that is a product of frequency "
        "and\n"
        "  direction. From {:.0f} to {:.0f} px: within 10 % on a whole picture. On a target 8 of 10 answers "
        "of 3 to 9 px\n"
        "  are within 25 %, but about half of such blurs pass for none, and cells of a marker may pass for "
        "blur.\n",
        kLeastBlur_px, kMostBlur_px);
  return text;
}

std::string fitness(const InspectReport& report) {
  std::string fit, limits;
  for (const Remark& remark : remarks(report))
    (remark.kind == Remark::Kind::fit ? fit : limits) += fmt::format("  - {}\n", remark.sentence);
  return (fit.empty() ? "" : "\nfit for\n" + fit) + (limits.empty() ? "" : "\nlimits\n" + limits);
}

}  // namespace

std::string inspect_text(const InspectReport& report) {
  return heading(report.sequence) + intervals(report.sequence.recording, report.inspection.intervals) +
         targets(report) + blur(report) + fitness(report);
}

}  // namespace relock
