#include "eval/judgement/states.h"

#include <algorithm>

#include "eval/definitions.h"

namespace relock {
namespace {

constexpr int kFramesToLock = 3;
constexpr int kFramesToLose = 3;
constexpr Duration kDriftTime = std::chrono::seconds(1);
constexpr Duration kFreshReport = std::chrono::milliseconds(500);
constexpr double kSameReport = 0.1;     // D
constexpr double kReportsShare = 0.25;  // of the way that report and target went towards each other

/// What a scored lost frame says; Hits are never asked.
LossKind said_on(const Observation& lost, LossRule rule) {
  if (lost.verdict == Verdict::Miss) return LossKind::Declared;
  if (lost.verdict == Verdict::WrongId) return LossKind::WrongId;
  return rule == LossRule::b && lost.hold ? LossKind::Drift : LossKind::Silent;
}

/// The largest share; a tie goes to the first of Silent, WrongId, Drift, Declared.
LossKind kind_of(const std::array<int, kLossKinds>& said) {
  return static_cast<LossKind>(std::max_element(said.begin(), said.end()) - said.begin());
}

}  // namespace

std::string_view to_string(State state) {
  constexpr std::string_view names[] = {"NotStarted", "Searching", "Locked", "Lost", "Out"};
  return names[static_cast<std::size_t>(state)];
}

std::string_view to_string(LossKind kind) {
  constexpr std::string_view names[] = {"Silent", "WrongId", "Drift", "Declared"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(LossEnd end) {
  constexpr std::string_view names[] = {"recovered", "chance",         "target_left",
                                        "reset",     "labels_stopped", "recording_stopped"};
  return names[static_cast<std::size_t>(end)];
}

std::string_view to_string(Acquisition::Kind kind) {
  constexpr std::string_view names[] = {"acquire", "reacquire", "resume"};
  return names[static_cast<std::size_t>(kind)];
}

void LockWatch::observe(const Observation& now) {
  ++frame_;
  if (last_shown_ && now.captured - *last_shown_ > kPause) paused_since_ = true;
  if (labels_stopped_before(now)) stop_labels();
  note_labels(now);
  if (state_ == State::NotStarted && now.verdict != Verdict::NotStarted)
    begin_search(Acquisition::Kind::acquire);

  const Seen seen{frame_, now};
  if (now.verdict == Verdict::Given) {
    give(seen);
  } else if (now.verdict == Verdict::FalseAlarm || now.verdict == Verdict::CorrectReject) {
    leave();
  } else if (scored(now.verdict)) {
    score(seen);
  }
  story_.states.push_back(state_);
}

LockWatch::Story LockWatch::finish() {
  if (state_ == State::Lost) end_loss(LossEnd::recording_stopped, last_scored_);
  if (state_ == State::Locked) end_lock();
  end_search({});
  return std::move(story_);
}

// Labels

bool LockWatch::labels_stopped_before(const Observation& now) const {
  if (now.label == Label::unlabelled || !last_labelled_) return false;
  return paused_since_ || (unlabelled_since_ && now.captured - *last_labelled_ > kLabelsStop);
}

void LockWatch::note_labels(const Observation& now) {
  last_shown_ = now.captured;
  if (now.label == Label::unlabelled) {
    unlabelled_since_ = true;
  } else {
    last_labelled_ = now.captured;
    unlabelled_since_ = paused_since_ = false;
  }
}

void LockWatch::stop_labels() {
  if (state_ == State::NotStarted) return;
  if (state_ == State::Lost) end_loss(LossEnd::labels_stopped, last_scored_);
  const bool holding = state_ == State::Locked && not_holds_.count == 0;
  if (state_ == State::Locked && !holding) end_lock();
  if (!holding) begin_search(Acquisition::Kind::resume);
  end_runs();
}

// Frames that change the state whatever came before

void LockWatch::give(const Seen& now) {
  if (state_ == State::Lost) end_loss(LossEnd::reset, frame_);
  if (state_ == State::Locked) end_lock();
  end_search({});
  end_runs();
  last_hold_ = last_hit_ = now;
  state_ = State::Locked;
}

void LockWatch::leave() {
  if (state_ == State::Lost) end_loss(LossEnd::target_left, last_scored_);
  if (state_ == State::Locked) end_lock();
  end_search({});
  end_runs();
  state_ = State::Out;
}

// Scored frames

void LockWatch::score(const Seen& now) {
  if (state_ == State::Out) begin_search(Acquisition::Kind::reacquire);
  if (state_ == State::Searching && !searching_from_) searching_from_ = frame_;
  update_runs(now);
  last_scored_ = frame_;
  if (state_ == State::Locked) {
    if (loses_lock(now)) {
      lose(LossRule::a, last_hold_, not_holds_.first);
    } else if (drifts_off(now)) {
      lose(LossRule::b, last_hit_, not_hits_.first);
    }
  } else if (locks()) {
    lock();
  } else if (state_ == State::Lost && now.what.verdict != Verdict::Hit) {
    say(now);
  }
}

void LockWatch::update_runs(const Seen& now) {
  const bool hit = now.what.verdict == Verdict::Hit;
  if (hit) {
    hits_.add(now);
    not_hits_.end();
    not_hits_while_locked_.clear();
    last_hit_ = now;
  } else {
    hits_.end();
    not_hits_.add(now);
    if (state_ == State::Locked) not_hits_while_locked_.push_back(now);
  }
  if (now.what.hold) {
    not_holds_.end();
    last_hold_ = now;
  } else {
    not_holds_.add(now);
  }
}

// Locks with 3 Hits in a row, the last at least 1.5 T after the first (three slots, ends included).
bool LockWatch::locks() const {
  return hits_.count >= kFramesToLock &&
         2 * (last_hit_.what.captured - hits_.first.what.captured) >= 3 * period_;
}

// Rule (a): 3 scored frames in a row are not Hold, and the last is at least 2.5 T after the last Hold.
bool LockWatch::loses_lock(const Seen& now) const {
  return not_holds_.count >= kFramesToLose &&
         2 * (now.what.captured - last_hold_.what.captured) >= 5 * period_;
}

// Rule (b): at a Hold, 3 scored frames since the last Hit are no Hits, first and last at least 1 s apart.
bool LockWatch::drifts_off(const Seen& now) const {
  return now.what.hold && not_hits_.count >= kFramesToLose &&
         now.what.captured - not_hits_.first.what.captured >= kDriftTime;
}

void LockWatch::lock() {
  const FrameIndex begins = hits_.first.frame;
  if (state_ == State::Lost) end_loss(came_to_the_report() ? LossEnd::chance : LossEnd::recovered, begins);
  end_search(begins);
  state_ = State::Locked;
  set_states(begins, State::Locked);
}

void LockWatch::lose(LossRule rule, const Seen& last_good, const Seen& first_lost) {
  Loss loss;
  loss.rule = rule;
  loss.last_good = last_good.frame;
  loss.first_lost = first_lost.frame;
  loss.declared = frame_;
  story_.losses.push_back(loss);
  state_ = State::Lost;
  set_states(last_good.frame, State::Lost);
  last_lost_report_.reset();
  missed_since_report_ = false;
  for (const Seen& lost : not_hits_while_locked_)
    if (lost.frame >= first_lost.frame) say(lost);
}

void LockWatch::say(const Seen& lost) {
  Loss& loss = story_.losses.back();
  ++loss.said[static_cast<std::size_t>(said_on(lost.what, loss.rule))];
  if (lost.what.verdict == Verdict::Miss) {
    missed_since_report_ = true;
  } else {
    last_lost_report_ = lost;
    missed_since_report_ = false;
  }
}

// Chance: from the last lost report (a) to the first Hit (b) the report stood still and the target came to
// it.
bool LockWatch::came_to_the_report() const {
  if (!last_lost_report_ || missed_since_report_) return false;
  const Observation& a = last_lost_report_->what;
  const Observation& b = hits_.first.what;
  if (a.verdict != Verdict::Stray || b.captured - a.captured > kFreshReport) return false;
  if (norm(b.reported - a.reported) > kSameReport * b.size_px) return false;
  const Vec2 to_truth = a.truth - a.reported;
  const double apart = norm(to_truth);
  if (apart == 0) return false;
  const double report_went = dot(b.reported - a.reported, to_truth) / apart;
  const double target_came = -dot(b.truth - a.truth, to_truth) / apart;
  return report_went < kReportsShare * (report_went + target_came);
}

// Beginnings and ends

void LockWatch::end_loss(LossEnd end, FrameIndex frame) {
  Loss& loss = story_.losses.back();
  loss.end = end;
  loss.end_frame = frame;
  loss.kind = kind_of(loss.said);
}

/// A lock that ends without a loss is credited up to its last Hold when non-Holds followed.
void LockWatch::end_lock() {
  if (not_holds_.count > 0) set_states(last_hold_.frame, State::Searching);
}

void LockWatch::begin_search(Acquisition::Kind kind) {
  end_search({});
  search_kind_ = kind;
  state_ = State::Searching;
}

void LockWatch::end_search(std::optional<FrameIndex> locked_at) {
  if (searching_from_) story_.acquisitions.push_back({search_kind_, *searching_from_, locked_at});
  searching_from_.reset();
}

void LockWatch::end_runs() {
  hits_.end();
  not_holds_.end();
  not_hits_.end();
  not_hits_while_locked_.clear();
}

/// Rewrites the state in force from frame `from` on, up to the frame being shown, which is written after it.
void LockWatch::set_states(FrameIndex from, State state) {
  std::fill(story_.states.begin() + from, story_.states.end(), state);
}

}  // namespace relock
