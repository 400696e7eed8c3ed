#include <algorithm>

#include "tests/eval/naive_parts.h"

namespace relock::naive {
namespace {

using std::size_t;

// --- Single frames.

bool is_given(const Look& look) { return look.verdict == Verdict::Given; }
bool is_hit(const Look& look) { return look.verdict == Verdict::Hit; }
bool is_not_hit(const Look& look) { return is_scored(look.verdict) && !is_hit(look); }
bool is_not_hold(const Look& look) { return is_scored(look.verdict) && !look.hold; }
bool is_absent_and_delivered(const Look& look) {
  return look.verdict == Verdict::FalseAlarm || look.verdict == Verdict::CorrectReject;
}
bool is_scored_or_given(const Look& look) { return is_scored(look.verdict) || is_given(look); }
// Given counts as Hit and Hold for the onset rules.
bool counts_as_hit(const Look& look) { return is_hit(look) || is_given(look); }
bool counts_as_hold(const Look& look) { return (is_scored(look.verdict) && look.hold) || is_given(look); }

std::optional<size_t> first_from(const Looks& looks, size_t k, size_t end, bool (*is)(const Look&)) {
  for (; k < end; ++k)
    if (is(looks[k])) return k;
  return {};
}

// Labels stop between the labelled frame k and the one before it.
bool labels_stop_before(const Looks& looks, size_t k) {
  if (!is_labelled(looks[k])) return false;
  const auto j = last_before(looks, k, is_labelled);
  if (!j) return false;
  const bool long_without = looks[k].captured - looks[*j].captured > std::chrono::milliseconds(500) &&
                            unlabelled_between(looks, *j, k);
  return long_without || pause_between(looks, *j, k);
}

// The scored frames in a row that end at frame k and are all of one kind. Unlabelled, Dropped and Skipped
// frames neither extend nor break a run; absent and Given frames and labels that stop end it.
std::vector<size_t> run_ending_at(const Looks& looks, size_t k, bool (*is)(const Look&)) {
  std::vector<size_t> run;
  for (size_t i = k + 1; i-- > 0;) {
    if (is_absent_and_delivered(looks[i]) || is_given(looks[i])) break;
    if (is_scored(looks[i].verdict)) {
      if (!is(looks[i])) break;
      run.insert(run.begin(), i);
    }
    if (labels_stop_before(looks, i)) break;
  }
  return run;
}

Duration from_to(const Looks& looks, size_t a, size_t b) { return looks[b].captured - looks[a].captured; }

// --- Events at one frame.

// A run of Hits locks when it has at least 3 Hits and the last is at least 1.5 T after the first.
std::optional<size_t> locks_at(const Looks& looks, size_t k, Duration period) {
  if (!is_hit(looks[k])) return {};
  const auto run = run_ending_at(looks, k, is_hit);
  if (run.size() >= 3 && 2 * from_to(looks, run.front(), run.back()) >= 3 * period) return run.front();
  return {};
}

// At least 3 consecutive scored frames are not Hold and the last of them is at least 2.5 T after the last
// Hold.
std::optional<Loss> loses_by_rule_a(const Looks& looks, size_t k, Duration period) {
  if (!is_not_hold(looks[k])) return {};
  const auto run = run_ending_at(looks, k, is_not_hold);
  const size_t last_hold = last_before(looks, k, counts_as_hold).value();
  if (run.size() < 3 || 2 * from_to(looks, last_hold, k) < 5 * period) return {};
  Loss loss;
  loss.rule = LossRule::a;
  loss.last_good = static_cast<FrameIndex>(last_hold);
  loss.first_lost = static_cast<FrameIndex>(run.front());
  loss.declared = static_cast<FrameIndex>(k);
  return loss;
}

// At a Hold, when at least 3 scored frames since the last Hit are no Hits and the first and last are 1 s
// apart.
std::optional<Loss> loses_by_rule_b(const Looks& looks, size_t k) {
  if (!is_not_hit(looks[k]) || !looks[k].hold) return {};
  const auto run = run_ending_at(looks, k, is_not_hit);
  if (run.size() < 3 || from_to(looks, run.front(), run.back()) < std::chrono::seconds(1)) return {};
  Loss loss;
  loss.rule = LossRule::b;
  loss.last_good = static_cast<FrameIndex>(last_before(looks, k, counts_as_hit).value());
  loss.first_lost = static_cast<FrameIndex>(run.front());
  loss.declared = static_cast<FrameIndex>(k);
  return loss;
}

// --- The story in chapters: each is one state, and what ended it.

enum class Ending { RecordingStops, LabelsStop, Given, Left, Returned, Locks, Loses };

struct Chapter {
  State state;
  size_t from;                 // first frame of the state, with hindsight
  size_t next;                 // first frame whose own event can end it
  Acquisition::Kind search{};  // of Searching
  Loss loss{};                 // of Lost
  Ending ending = Ending::RecordingStops;
  size_t end = 0;  // the frame at which it was ended; the number of frames by the recording's end
};

Chapter searching(size_t from, Acquisition::Kind kind) {
  return {.state = State::Searching, .from = from, .next = from, .search = kind};
}
Chapter locked(size_t from, size_t known) {
  return {.state = State::Locked, .from = from, .next = known + 1};
}
Chapter out(size_t from) { return {.state = State::Out, .from = from, .next = from + 1}; }
Chapter lost(const Loss& loss) {
  return {.state = State::Lost,
          .from = static_cast<size_t>(loss.last_good),
          .next = static_cast<size_t>(loss.declared) + 1,
          .loss = loss};
}

// Labels that stop before frame k end every state but Locked, and that too unless the last scored or Given
// frame was a Hold. They can end a chapter only when it was there before k.
bool ended_by_labels(const Looks& looks, const Chapter& chapter, size_t k) {
  if (!labels_stop_before(looks, k)) return false;
  if (chapter.state != State::Locked) return true;
  return !counts_as_hold(looks[last_before(looks, k, is_scored_or_given).value()]);
}

// Looks on until something ends the chapter, and says what begins then.
std::optional<Chapter> next_chapter(const Looks& looks, Duration period, Chapter& chapter) {
  const auto end_by = [&](Ending ending, size_t k, const Chapter& next) {
    chapter.ending = ending;
    chapter.end = k;
    return next;
  };
  const bool began_by_its_first = chapter.state == State::Searching;
  for (size_t k = chapter.next; k < looks.size(); ++k) {
    const bool was_there_before = k > chapter.next || !began_by_its_first;
    if (was_there_before && ended_by_labels(looks, chapter, k))
      return end_by(Ending::LabelsStop, k, searching(k, Acquisition::Kind::resume));
    if (is_given(looks[k])) return end_by(Ending::Given, k, locked(k, k));
    if (chapter.state == State::Out) {
      if (is_scored(looks[k].verdict))
        return end_by(Ending::Returned, k, searching(k, Acquisition::Kind::reacquire));
      continue;
    }
    if (is_absent_and_delivered(looks[k])) return end_by(Ending::Left, k, out(k));
    if (chapter.state == State::Locked) {
      if (const auto loss = loses_by_rule_a(looks, k, period)) return end_by(Ending::Loses, k, lost(*loss));
      if (const auto loss = loses_by_rule_b(looks, k)) return end_by(Ending::Loses, k, lost(*loss));
    } else if (const auto first_hit = locks_at(looks, k, period)) {
      return end_by(Ending::Locks, k, locked(*first_hit, k));
    }
  }
  chapter.ending = Ending::RecordingStops;
  chapter.end = looks.size();
  return {};
}

// Whatever ends a lock, it is credited up to its last Hold when non-Holds followed; from there on it is a
// search.
std::optional<Chapter> tail_of(const Looks& looks, const Chapter& lock) {
  if (lock.ending == Ending::Loses) return {};
  const auto last = last_before(looks, lock.end, is_scored_or_given);
  if (counts_as_hold(looks[*last])) return {};
  Chapter tail = searching(*last_before(looks, lock.end, counts_as_hold), Acquisition::Kind::resume);
  tail.next = tail.end = lock.end;
  return tail;
}

std::vector<Chapter> chapters_of(const Looks& looks, Duration period) {
  std::vector<Chapter> chapters;
  const auto start =
      first_from(looks, 0, looks.size(), [](const Look& l) { return l.verdict != Verdict::NotStarted; });
  std::optional<Chapter> chapter;
  if (start) chapter = searching(*start, Acquisition::Kind::acquire);
  while (chapter) {
    const auto next = next_chapter(looks, period, *chapter);
    chapters.push_back(*chapter);
    if (chapter->state == State::Locked)
      if (const auto tail = tail_of(looks, *chapter)) chapters.push_back(*tail);
    chapter = next;
  }
  return chapters;
}

// A search during which no scored frame occurs is none.
std::optional<Acquisition> acquisition_of(const Looks& looks, const Chapter& search,
                                          std::optional<size_t> locked_at) {
  const auto from =
      first_from(looks, search.next, search.end, [](const Look& l) { return is_scored(l.verdict); });
  if (!from) return {};
  Acquisition acquisition{search.search, static_cast<FrameIndex>(*from), {}};
  if (search.ending == Ending::Locks) acquisition.locked_at = static_cast<FrameIndex>(*locked_at);
  return acquisition;
}

Loss finished(const Looks& looks, const Chapter& chapter, std::optional<size_t> locked_at) {
  Loss loss = chapter.loss;
  size_t end = *last_before(looks, chapter.end, [](const Look& l) { return is_scored(l.verdict); });
  size_t said_until = chapter.end;
  switch (chapter.ending) {
    case Ending::Given:
      loss.end = LossEnd::reset;
      end = chapter.end;
      break;
    case Ending::Left:
      loss.end = LossEnd::target_left;
      break;
    case Ending::LabelsStop:
      loss.end = LossEnd::labels_stopped;
      break;
    case Ending::Locks:
      loss.end = is_chance(looks, loss, *locked_at) ? LossEnd::chance : LossEnd::recovered;
      end = said_until = *locked_at;
      break;
    default:
      loss.end = LossEnd::recording_stopped;
  }
  loss.end_frame = static_cast<FrameIndex>(end);
  loss.said = said_while_lost(looks, loss, said_until);
  loss.kind = largest_share(loss.said);
  return loss;
}

}  // namespace

Story story_of(const Looks& looks, Duration period) {
  Story story;
  story.states.assign(looks.size(), State::NotStarted);
  const auto chapters = chapters_of(looks, period);
  for (size_t i = 0; i < chapters.size(); ++i) {
    const Chapter& chapter = chapters[i];
    std::fill(story.states.begin() + static_cast<std::ptrdiff_t>(chapter.from), story.states.end(),
              chapter.state);
    std::optional<size_t> locked_at;
    if (chapter.ending == Ending::Locks) locked_at = chapters[i + 1].from;
    if (chapter.state == State::Lost) story.losses.push_back(finished(looks, chapter, locked_at));
    if (chapter.state == State::Searching)
      if (const auto search = acquisition_of(looks, chapter, locked_at))
        story.acquisitions.push_back(*search);
  }
  return story;
}

}  // namespace relock::naive
