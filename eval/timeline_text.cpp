#include "eval/timeline_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "eval/judgement/circumstances.h"
#include "eval/loss_text.h"
#include "eval/replay/vot_rules.h"
#include "eval/scores/localization.h"
#include "eval/scores/scores.h"

namespace relock {
namespace {

struct Glyph {
  std::string_view block;   // in place of the letter, where the terminal has Unicode
  std::string_view colour;  // ANSI; Okabe and Ito's colours, told apart by the colour-blind too
  std::string_view meaning;
  int badness;  // the worse of two verdicts stands for a column that holds both equally often
};
constexpr std::array<Glyph, kVerdicts> kGlyphs{{{" ", "", "not started", 0},
                                                {"·", "\x1b[90m", "no frame", 1},
                                                {"-", "\x1b[90m", "skipped", 2},
                                                {"▼", "\x1b[1m", "given", 3},
                                                {"?", "\x1b[90m", "unlabelled", 1},
                                                {"█", "\x1b[38;5;36m", "Hit", 4},
                                                {"✖", "\x1b[38;5;175m", "WrongId", 8},
                                                {"▒", "\x1b[38;5;166m", "Stray", 9},
                                                {"▁", "\x1b[38;5;32m", "Miss", 7},
                                                {"!", "\x1b[38;5;175m", "FalseAlarm", 6},
                                                {"░", "\x1b[90m", "CorrectReject", 5}}};

/// Slot of every recorded frame, the first one's being 0.
std::vector<std::int64_t> slots_of_frames(const Recording& recording) {
  std::vector<std::int64_t> all{0};
  for (std::size_t i = 1; i < recording.frames(); ++i)
    all.push_back(all.back() + slots(recording.captured[i] - recording.captured[i - 1], recording.period));
  return all;
}

/// Maps slots to the lane's columns.
struct Columns {
  std::int64_t slots, columns;
  std::int64_t of(std::int64_t slot) const { return slot * columns / slots; }
};

Columns columns_of(const std::vector<std::int64_t>& frame_slots, const TimelineStyle& style) {
  const std::int64_t slots = frame_slots.back() + 1;
  return {slots, std::min<std::int64_t>(slots, std::max(1, style.columns))};
}

Verdict most_frequent(const std::array<int, kVerdicts>& count) {
  if (count[static_cast<std::size_t>(Verdict::Given)] > 0) return Verdict::Given;  // starts are never hidden
  std::size_t best = 0;
  for (std::size_t v = 1; v < kVerdicts; ++v) {
    if (count[v] > count[best] || (count[v] == count[best] && kGlyphs[v].badness > kGlyphs[best].badness))
      best = v;
  }
  return static_cast<Verdict>(best);
}

class Story {
 public:
  Story(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
        std::size_t target)
      : recording_(recording),
        trajectory_(trajectory),
        timeline_(evaluation.targets[target]),
        target_(target) {}

  std::string tell() const {
    if (!trajectory_.judged_from[target_]) return "not asked";
    std::string text;
    if (called_off()) {
      text = failures();
    } else if (timeline_.losses.empty()) {
      text = never_lost();
    } else if (timeline_.losses.size() == 1) {
      text = one_loss(timeline_.losses[0]);
    } else {
      text = several_losses();
    }
    if (const auto vain = searches_in_vain(); vain > 0 && text != "never locked")
      text += vain == 1 ? "; once not found again" : fmt::format("; {} times not found again", vain);
    if (const auto& failed = trajectory_.failed_from[target_])
      text += fmt::format("; failed at {:.2f} s", at(*failed));
    return text;
  }

 private:
  double at(FrameIndex frame) const {
    return seconds(recording_.captured[static_cast<std::size_t>(frame)] - recording_.captured.front());
  }

  /// Protocol vot: the method failed, and frames were withheld from it.
  bool called_off() const {
    for (auto frame = static_cast<std::size_t>(*trajectory_.judged_from[target_]);
         frame < trajectory_.frames.size(); ++frame) {
      const auto& withheld = trajectory_.frames[frame].withheld;
      if (std::binary_search(withheld.begin(), withheld.end(), target_)) return true;
    }
    return false;
  }

  /// By VOT's rules: a loss takes three frames, a failure one.
  std::string failures() const {
    const auto frames = vot_frames(recording_, trajectory_, target_);
    const auto failures = std::count(frames.begin(), frames.end(), VotFrame::failure);
    const auto starts = std::count(frames.begin(), frames.end(), VotFrame::start);
    return fmt::format("{} failure{}, {} started again", failures, failures == 1 ? "" : "s", starts - 1);
  }

  std::string never_lost() const {
    const bool locked =
        std::find(timeline_.states.begin(), timeline_.states.end(), State::Locked) != timeline_.states.end();
    if (!locked) return "never locked";
    if (!timeline_.acquisitions.empty() && timeline_.acquisitions[0].locked_at) {
      const auto& search = timeline_.acquisitions[0];
      const double waited = at(*search.locked_at) - at(search.from);
      if (waited > 0) return fmt::format("found after {:.2f} s and kept", waited);
    }
    return searches_in_vain() == 0 ? "kept throughout" : "never lost while the target was there";
  }

  std::ptrdiff_t searches_in_vain() const {
    return std::count_if(timeline_.acquisitions.begin(), timeline_.acquisitions.end(),
                         [](const Acquisition& search) { return !search.locked_at; });
  }

  std::string one_loss(const Loss& loss) const {
    const Circumstances c = circumstances(recording_, trajectory_, target_, loss);
    return fmt::format("{}; {}", onset_text(recording_, loss, c), end_text(recording_, loss));
  }

  std::string several_losses() const {
    std::vector<double> recovered;
    std::size_t restarted = 0, by_chance = 0;
    for (const Loss& loss : timeline_.losses) {
      if (loss.end == LossEnd::recovered) recovered.push_back(seconds(loss_time(recording_, loss)));
      if (loss.end == LossEnd::reset) ++restarted;
      if (loss.end == LossEnd::chance) ++by_chance;
    }
    const std::size_t losses = timeline_.losses.size(),
                      open = losses - recovered.size() - restarted - by_chance;
    std::string text = fmt::format("{} losses", losses);
    if (!recovered.empty())
      text += fmt::format(", {}recovered in {}",
                          recovered.size() == losses ? "" : fmt::format("{} ", recovered.size()),
                          times(recovered));
    if (restarted > 0) text += fmt::format(", {} started again", restarted);
    if (by_chance > 0) text += fmt::format(", {} ended by chance", by_chance);
    if (open > 0) text += fmt::format(", {} not recovered", open);
    return text;
  }

  static std::string times(const std::vector<double>& all) {
    if (all.size() > 3)
      return fmt::format("{:.2f} s (median; longest {:.2f} s)", percentile(all, 0.5),
                         *std::max_element(all.begin(), all.end()));
    std::vector<std::string> words;
    for (const double time : all) words.push_back(fmt::format("{:.2f} s", time));
    return joined(words);
  }

  const Recording& recording_;
  const Trajectory& trajectory_;
  const TargetTimeline& timeline_;
  std::size_t target_;
};

/// The smallest of 1, 2, 5 times a power of ten, s, that is at least `least`.
double round_step(double least) {
  double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

void append_glyph(std::string& text, Verdict verdict, const TimelineStyle& style) {
  const Glyph& glyph = kGlyphs[static_cast<std::size_t>(verdict)];
  const bool coloured = style.colour && !glyph.colour.empty();
  if (coloured) text += glyph.colour;
  if (style.unicode) {
    text += glyph.block;
  } else {
    text += letter(verdict);
  }
  if (coloured) text += "\x1b[0m";
}

}  // namespace

std::string lane(const Recording& recording, const TargetTimeline& timeline, const TimelineStyle& style) {
  const auto frame_slots = slots_of_frames(recording);
  const Columns columns = columns_of(frame_slots, style);
  std::vector<std::array<int, kVerdicts>> counts(static_cast<std::size_t>(columns.columns));
  std::int64_t next_slot = 0;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    for (; next_slot < frame_slots[frame]; ++next_slot)  // not recorded
      ++counts[static_cast<std::size_t>(columns.of(next_slot))][static_cast<std::size_t>(Verdict::Dropped)];
    const auto verdict = static_cast<std::size_t>(timeline.judgements[frame].verdict);
    ++counts[static_cast<std::size_t>(columns.of(next_slot++))][verdict];
  }
  std::string text;
  for (const auto& count : counts) append_glyph(text, most_frequent(count), style);
  return text;
}

std::string ruler(const Recording& recording, const TimelineStyle& style) {
  const auto frame_slots = slots_of_frames(recording);
  const Columns columns = columns_of(frame_slots, style);
  const double seconds_per_column =
      seconds(recording.period) * static_cast<double>(columns.slots) / static_cast<double>(columns.columns);
  const double step = round_step(10 * seconds_per_column);  // room for a label
  std::string text(static_cast<std::size_t>(columns.columns), ' ');
  for (int mark = 0;; ++mark) {
    const auto column = static_cast<std::size_t>(std::llround(mark * step / seconds_per_column));
    if (column >= text.size()) break;
    const std::string label = mark == 0 ? "|0 s" : fmt::format("|{:g}", mark * step);
    if (column + label.size() > text.size() + 4) break;
    if (column + label.size() > text.size()) text.resize(column + label.size(), ' ');
    text.replace(column, label.size(), label);
  }
  return text;
}

std::string legend(const TimelineStyle& style) {
  std::string text;
  for (const Verdict v :
       {Verdict::Given, Verdict::Hit, Verdict::Stray, Verdict::Miss, Verdict::WrongId, Verdict::Dropped,
        Verdict::FalseAlarm, Verdict::CorrectReject, Verdict::Unlabelled}) {
    if (!text.empty()) text += "  ";
    append_glyph(text, v, style);
    text += fmt::format(" {}", kGlyphs[static_cast<std::size_t>(v)].meaning);
  }
  return text;
}

std::string story(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
                  std::size_t target) {
  return Story(recording, trajectory, evaluation, target).tell();
}

}  // namespace relock
