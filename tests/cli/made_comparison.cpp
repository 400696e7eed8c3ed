#include "made_comparison.h"

#include <set>

namespace relock {
namespace {

constexpr double kSide = 40, kApart = 150;

Box place_of(std::size_t target) { return {100 + kApart * static_cast<double>(target), 100, kSide, kSide}; }

Recording made_recording(const std::string& name, std::size_t targets, std::size_t frames) {
  Recording made{name, {640, 360}, period_of(30), {}, {}, {}};
  for (std::size_t t = 0; t < targets; ++t) made.targets.push_back({"target " + std::to_string(t)});
  made.targets.front().code = Code{"ring", "01"};
  for (std::size_t frame = 0; frame < frames; ++frame) {
    made.captured.push_back(Time{static_cast<std::int64_t>(frame) * made.period});
    for (std::size_t t = 0; t < targets; ++t) {
      TargetTruth truth{Label::visible};
      truth.outline = place_of(t);
      if (t == 0) truth.blur = Vec2{static_cast<double>(frame), 0};
      made.truth.push_back(truth);
    }
  }
  return made;
}

FrameReport report_of(const Recording& recording, const MadeRun& run, std::size_t frame) {
  FrameReport report;
  for (std::size_t t = 0; t < run.targets.size(); ++t) {
    const char letter = run.targets[t].at(frame);
    if (letter == '.') report.delivery = Delivery::dropped;
    if (letter != 'H' && letter != 'S') continue;
    Box box = place_of(t);
    if (letter == 'S') box.y += 2 * kSide;
    Sighting sighting = sighting_of(box);
    sighting.centre.x += 0.01 * static_cast<double>(frame % 7);
    sighting.track = recording.targets[t].id;
    report.sightings.push_back(sighting);
  }
  if (report.delivery != Delivery::delivered) report.sightings.clear();
  return report;
}

StoredRun stored_run(const Recording& recording, const MadeRun& run, const MadeConditions& conditions) {
  StoredRun stored;
  stored.record.gaps = conditions.gaps;
  stored.record.seed = conditions.seed;
  stored.record.protocol = conditions.protocol;
  stored.record.anchor = conditions.anchor;
  stored.record.real_time = conditions.real_time;
  stored.record.latency = conditions.latency;
  stored.record.recording = recording.name;
  stored.record.method = run.method;
  stored.record.yardstick = run.yardstick;
  stored.trajectory.method = run.method;
  stored.trajectory.judged_from.assign(recording.targets.size(), 0);
  stored.trajectory.failed_from.resize(recording.targets.size());
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    stored.trajectory.frames.push_back(report_of(recording, run, frame));
    const bool answered = stored.trajectory.frames.back().delivery == Delivery::delivered;
    if (!conditions.real_time.empty() && answered)
      stored.answers.push_back(
          {static_cast<FrameIndex>(frame), recording.captured[frame], recording.captured[frame]});
  }
  return stored;
}

}  // namespace

StoredComparison made_comparison(const std::string& recording, const std::vector<MadeRun>& runs,
                                 const MadeConditions& conditions) {
  const auto& targets = runs.front().targets;
  StoredComparison made{{}, made_recording(recording, targets.size(), targets.front().size()), {}};
  for (const MadeRun& run : runs) made.runs.push_back(stored_run(made.recording, run, conditions));
  return made;
}

std::string with_outages(std::size_t frames, std::size_t every, std::size_t length, std::size_t from) {
  std::string letters(frames, 'H');
  for (std::size_t n = 0; n * every + from < frames; ++n)
    for (std::size_t i = 0; i < length; ++i) {
      const std::size_t frame = n * every + from + n * n % 5 + i;
      if (frame < frames) letters[frame] = 'M';
    }
  return letters;
}

std::vector<ScoreTable> pooled_tables(const std::vector<StoredComparison>& all, Grouping grouping,
                                      const Gate& gate) {
  std::set<std::string> recordings;
  for (const StoredComparison& one : all) recordings.insert(one.recording.name);
  ScorePool pool(grouping, recordings.size());
  for (const StoredComparison& one : all) pool.add(scored(one, gate));
  return std::move(pool).tables();
}

std::vector<JudgedTable> judged_tables(const std::vector<StoredComparison>& all, Grouping grouping) {
  std::vector<JudgedTable> tables;
  for (ScoreTable& table : pooled_tables(all, grouping)) {
    auto methods = judged(table);
    tables.push_back({std::move(table), std::move(methods)});
  }
  return tables;
}

}  // namespace relock
