// `relock explain`: every loss in order, with what it came with and how it ended.

#include <fmt/format.h>

#include <algorithm>

#include "cli/chosen_target.h"
#include "cli/comparison.h"
#include "cli/json_text.h"
#include "cli/loss_sentences.h"
#include "cli/readable.h"
#include "cli/table.h"
#include "cli/verbs.h"
#include "eval/judgement/circumstances.h"
#include "eval/scores/scores.h"
#include "eval/timeline_text.h"

namespace relock {
namespace {

/// What one run said of one target.
struct Case {
  const StoredComparison& comparison;
  const StoredRun& run;
  const Evaluation& evaluation;
  std::size_t target;

  const Recording& recording() const { return comparison.recording; }
  const TargetTimeline& timeline() const { return evaluation.targets[target]; }
  Circumstances of(const Loss& loss) const {
    return circumstances(recording(), run.trajectory, target, loss);
  }
  LossSentences sentences(const Loss& loss) const {
    return sentences_of(recording(), run.trajectory, target, loss);
  }
  double at(FrameIndex frame) const {
    return seconds(recording().captured[static_cast<std::size_t>(frame)] - recording().captured.front());
  }
};

/// "Started with the box at 0.00 s" is no search; what took no time needs no word.
bool took_time(const Acquisition& search) { return !search.locked_at || *search.locked_at > search.from; }

std::string text_of(const Case& c, const Acquisition& search) {
  const std::string_view why = search.kind == Acquisition::Kind::acquire     ? ""
                               : search.kind == Acquisition::Kind::reacquire ? " when the target was back"
                                                                             : " when labels went on";
  if (!search.locked_at)
    return fmt::format("searched for from {:.2f} s on{}, and not found", c.at(search.from), why);
  return fmt::format("searched for from {:.2f} s on{}, and found in {:.2f} s", c.at(search.from), why,
                     c.at(*search.locked_at) - c.at(search.from));
}

// Sentences

struct Told {
  FrameIndex when;
  std::string text;
};

/// All that happened to the target, in order; losses are numbered.
std::vector<Told> told(const Case& c) {
  std::vector<Told> all;
  std::size_t number = 0;
  for (const Loss& loss : c.timeline().losses) {
    const LossSentences sentences = c.sentences(loss);
    std::string text = fmt::format("  {:>3}. {}\n", ++number, sentences.what);
    for (const std::string& more : {sentences.target, sentences.said})
      if (!more.empty()) text += fmt::format("       {}\n", more);
    all.push_back({loss.last_good, text});
  }
  for (const Acquisition& search : c.timeline().acquisitions)
    if (took_time(search))
      all.push_back({search.from, fmt::format("       {}\n", as_sentence(text_of(c, search)))});
  if (const auto& failed = c.run.trajectory.failed_from[c.target])
    all.push_back({*failed, fmt::format("       Failed at {:.2f} s; it gave no answer from there on.\n",
                                        c.at(*failed))});
  if (const auto& cut = c.run.record.cut_short)
    all.push_back({cut->frame, fmt::format("       The recording could not be read beyond frame {}: {}.\n",
                                           cut->frame, cut->what)});
  std::stable_sort(all.begin(), all.end(), [](const Told& a, const Told& b) { return a.when < b.when; });
  return all;
}

// Columns

std::string spoken(LossEnd end) {
  std::string text(to_string(end));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

using Row = std::vector<std::string>;

/// Without the columns that are n/a throughout: the recording does not know them.
Table known_columns(const std::vector<Row>& rows) {
  std::vector<Row> known(rows.size());
  for (std::size_t column = 0; column < rows.front().size(); ++column) {
    if (std::all_of(rows.begin() + 1, rows.end(), [&](const Row& row) { return row[column] == "n/a"; }))
      continue;
    for (std::size_t i = 0; i < rows.size(); ++i) known[i].push_back(rows[i][column]);
  }
  Table table(known.front());
  for (std::size_t i = 1; i < known.size(); ++i) table.add(known[i]);
  return table;
}

Table columns_of_losses(const Case& c) {
  std::vector<Row> rows{{"#", "onset s", "rule", "kind", "slots", "injected", "blur px", "moved D",
                         "border px", "tilt deg", "D px", "ended by", "after s"}};
  std::size_t number = 0;
  for (const Loss& loss : c.timeline().losses) {
    const Circumstances with = c.of(loss);
    rows.push_back(
        {std::to_string(++number), fmt::format("{:.2f}-{:.2f}", c.at(loss.last_good), c.at(loss.first_lost)),
         loss.rule == LossRule::a ? "a" : "b", std::string(to_string(loss.kind)), std::to_string(with.slots),
         std::to_string(with.slots_injected), cell(with.blur_px, 1), cell(with.displacement_d, 2),
         cell(with.border_px, 0), cell(with.tilt_deg, 0), cell(with.size_px, 0), spoken(loss.end),
         fmt::format("{:.2f}", seconds(loss_time(c.recording(), loss)))});
  }
  return known_columns(rows);
}

void print(const Case& c) {
  const std::size_t losses = c.timeline().losses.size();
  fmt::print("\n  {}, target {}: {}\n", c.run.record.method, c.recording().targets[c.target].id,
             losses == 0   ? story(c.recording(), c.run.trajectory, c.evaluation, c.target)
             : losses == 1 ? "1 loss"
                           : fmt::format("{} losses", losses));
  for (const Told& event : told(c)) fmt::print("{}", event.text);
  if (losses > 0) fmt::print("\n{}", columns_of_losses(c).text(4));
}

// JSON

Json json_of(const Case& c, const Loss& loss) {
  const Circumstances with = c.of(loss);
  Json said;
  for (std::size_t kind = 0; kind < kLossKinds; ++kind)
    said[std::string(to_string(static_cast<LossKind>(kind)))] = loss.said[kind];
  return {{"sentence", c.sentences(loss).what},
          {"onset_s", {c.at(loss.last_good), c.at(loss.first_lost)}},
          {"rule", loss.rule == LossRule::a ? "a" : "b"},
          {"kind", to_string(loss.kind)},
          {"said", said},
          {"ended_by", to_string(loss.end)},
          {"duration_s", seconds(loss_time(c.recording(), loss))},
          {"slots", with.slots},
          {"slots_recorded", with.slots_recorded},
          {"slots_injected", with.slots_injected},
          {"slots_skipped", with.slots_skipped},
          {"blur_px", number(with.blur_px)},
          {"displacement_d", number(with.displacement_d)},
          {"border_px", number(with.border_px)},
          {"tilt_deg", number(with.tilt_deg)},
          {"size_px", number(with.size_px)}};
}

Json json_of(const Case& c, const Acquisition& search) {
  return {{"kind", to_string(search.kind)},
          {"from_s", c.at(search.from)},
          {"locked_s", search.locked_at ? Json(c.at(*search.locked_at)) : Json()}};
}

Json json_of(const Case& c) {
  const RunRecord& record = c.run.record;
  const auto& failed = c.run.trajectory.failed_from[c.target];
  Json losses = Json::array(), searches = Json::array();
  for (const Loss& loss : c.timeline().losses) losses.push_back(json_of(c, loss));
  for (const Acquisition& search : c.timeline().acquisitions) searches.push_back(json_of(c, search));
  return {{"recording", record.recording},
          {"gaps", record.gaps},
          {"seed", record.seed},
          {"protocol", to_string(record.protocol)},
          {"start", record.anchor ? Json(to_string(*record.anchor)) : Json()},
          {"real_time", record.real_time},
          {"latency", record.latency},
          {"gate", to_string(c.evaluation.gate)},
          {"method", record.method},
          {"target", c.recording().targets[c.target].id},
          {"losses", losses},
          {"searches", searches},
          {"failed_s", failed ? Json(c.at(*failed)) : Json()}};
}

// Which runs

/// Yardsticks lose what they are made to lose; they are told only when nothing else is there.
bool of_interest(const StoredComparison& comparison, const StoredRun& run) {
  const auto is_yardstick = [](const StoredRun& r) { return r.record.yardstick; };
  return !run.record.yardstick || std::all_of(comparison.runs.begin(), comparison.runs.end(), is_yardstick);
}

/// Shows every target of every run of interest to `tell`.
template <class Tell>
void for_each_case(const StoredComparison& comparison, const Gate& gate, const std::optional<TargetId>& only,
                   const Tell& tell) {
  for (const StoredRun& run : comparison.runs) {
    if (!of_interest(comparison, run)) continue;
    const Evaluation evaluation = evaluate(comparison.recording, run.trajectory, gate);
    for (std::size_t t = 0; t < comparison.recording.targets.size(); ++t)
      if (wanted(comparison.recording.targets[t], only) && run.trajectory.judged_from[t])
        tell(Case{comparison, run, evaluation, t});
  }
}

void explain_all(const std::vector<StoredComparison>& all, const ExplainArguments& arguments) {
  check_target(all, arguments.target);
  Json objects = Json::array();
  bool first = true;
  for (const StoredComparison& comparison : all) {
    const Gate gate = gate_of(comparison, arguments.gate);
    if (!arguments.json) fmt::print("{}{}\n", first ? "" : "\n", heading(comparison, gate));
    first = false;
    for_each_case(comparison, gate, arguments.target, [&](const Case& c) {
      if (arguments.json) {
        objects.push_back(json_of(c));
      } else {
        print(c);
      }
    });
  }
  if (arguments.json) fmt::print("{}", json_text(objects));
}

}  // namespace

int explain(const ExplainArguments& arguments) {
  return with_readable(find_results(arguments.folder),
                       [&](const std::vector<StoredComparison>& all) { explain_all(all, arguments); });
}

}  // namespace relock
