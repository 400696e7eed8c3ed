#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "eval/judgement/verdict.h"

namespace relock {

/// Whether a method has a target (metrics.md section 4).
enum class State : std::uint8_t { NotStarted, Searching, Locked, Lost, Out };
std::string_view to_string(State state);

/// The rule by which a lock was lost.
enum class LossRule : std::uint8_t {
  a,  ///< 3 scored frames in a row not Hold, the last at least 2.5 T after the last Hold
  b,  ///< drift: held, but 3 scored frames and 1 s without a Hit
};
/// What was said while lost.
enum class LossKind : std::uint8_t { Silent, WrongId, Drift, Declared };
constexpr std::size_t kLossKinds = 4;
std::string_view to_string(LossKind kind);
/// How a loss ended. Only `recovered` is a recovery; all others are censorings.
enum class LossEnd : std::uint8_t {
  recovered,
  chance,
  target_left,
  reset,
  labels_stopped,
  recording_stopped
};
std::string_view to_string(LossEnd end);

/// A lock lost. The onset is an interval, from the last frame that held to the first that did not: a gap in
/// the recording widens it. Scores use its early end.
struct Loss {
  LossRule rule = LossRule::a;
  LossKind kind = LossKind::Declared;
  FrameIndex last_good = 0;  ///< last Hold (rule a) or last Hit (rule b): the onset is after its time …
  FrameIndex first_lost = 0;  ///< … and at or before the time of this one, the first scored frame of the loss
  FrameIndex declared = 0;    ///< the frame on which the rule was met
  LossEnd end = LossEnd::recording_stopped;
  /// recovered, chance: the first Hit of the new lock. reset: the Given frame. Else the last scored frame.
  FrameIndex end_frame = 0;
  std::array<int, kLossKinds> said{};  ///< scored lost frames of each kind, isolated Hits aside
  friend bool operator==(const Loss&, const Loss&) = default;
};

/// A search for the target, from the first frame on which it was searched for to the lock.
struct Acquisition {
  enum class Kind : std::uint8_t {
    acquire,    ///< at the start
    reacquire,  ///< after the target returned
    resume,     ///< after the labels had stopped, or a lock that non-Holds had ended
  };
  Kind kind = Kind::acquire;
  FrameIndex from = 0;                       ///< first scored frame of the search
  std::optional<FrameIndex> locked_at = {};  ///< first Hit of the lock; nothing: it never came
  friend bool operator==(const Acquisition&, const Acquisition&) = default;
};
std::string_view to_string(Acquisition::Kind kind);

/// One target's verdicts and what follows from them.
struct TargetTimeline {
  std::vector<Judgement> judgements;      ///< of every recorded frame
  std::vector<State> states;              ///< in force from each recorded frame to the next, with hindsight
  std::vector<Loss> losses;               ///< in order
  std::vector<Acquisition> acquisitions;  ///< in order
};

/// What the state of a lock depends on, of one target on one recorded frame.
struct Observation {
  Time captured;
  Label label = Label::unlabelled;
  Verdict verdict = Verdict::NotStarted;
  bool hold = false;
  // Of a Hit or Stray: where it was reported, where it was, and its size; px.
  Vec2 reported;
  Vec2 truth;
  double size_px = 0;
};

/// Follows one target's state, frame by frame. It knows nothing of later frames, so that replay can ask it
/// when a loss is declared; `finish` tells the whole story with hindsight.
class LockWatch {
 public:
  explicit LockWatch(Duration period) : period_(period) {}

  /// The next recorded frame. All frames are shown, delivered or not.
  void observe(const Observation& now);

  /// As known after the last frame shown.
  State state() const { return state_; }

  struct Story {
    std::vector<State> states;
    std::vector<Loss> losses;
    std::vector<Acquisition> acquisitions;
  };
  /// Ends the recording.
  Story finish();

 private:
  /// A scored or Given frame.
  struct Seen {
    FrameIndex frame = -1;
    Observation what;
  };
  /// Scored frames in a row. Unlabelled, Dropped and Skipped frames neither extend nor break it.
  struct Run {
    int count = 0;
    Seen first;
    void add(const Seen& seen) {
      if (count++ == 0) first = seen;
    }
    void end() { count = 0; }
  };

  bool labels_stopped_before(const Observation& now) const;
  void note_labels(const Observation& now);
  void stop_labels();
  void give(const Seen& now);
  void leave();
  void score(const Seen& now);
  void update_runs(const Seen& now);
  bool locks() const;
  bool loses_lock(const Seen& now) const;
  bool drifts_off(const Seen& now) const;
  void lock();
  void lose(LossRule rule, const Seen& last_good, const Seen& first_lost);
  void say(const Seen& lost);
  bool came_to_the_report() const;
  void end_loss(LossEnd end, FrameIndex frame);
  void end_lock();
  void begin_search(Acquisition::Kind kind);
  void end_search(std::optional<FrameIndex> locked_at);
  void end_runs();
  void set_states(FrameIndex from, State state);

  Duration period_;
  State state_ = State::NotStarted;
  FrameIndex frame_ = -1;  // the last one shown
  Story story_;

  std::optional<Time> last_shown_;
  std::optional<Time> last_labelled_;
  bool unlabelled_since_ = false;
  bool paused_since_ = false;

  Run hits_;
  Run not_holds_;
  Run not_hits_;
  std::vector<Seen> not_hits_while_locked_;  // since the last Hit: what a loss will have been saying
  Seen last_hold_;                           // a Given frame counts
  Seen last_hit_;                            // likewise
  FrameIndex last_scored_ = -1;

  // Of the running loss.
  std::optional<Seen> last_lost_report_;
  bool missed_since_report_ = false;
  // Of the running search.
  Acquisition::Kind search_kind_ = Acquisition::Kind::acquire;
  std::optional<FrameIndex> searching_from_;
};

}  // namespace relock
