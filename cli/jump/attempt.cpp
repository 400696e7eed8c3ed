#include "cli/jump/attempt.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "cli/runs/child.h"
#include "cli/terminal.h"
#include "core/error.h"
#include "core/picture.h"
#include "eval/judgement/verdict.h"
#include "eval/replay/replay.h"

namespace relock::jumps {
namespace {

constexpr auto kPatience = std::chrono::seconds(60);  // for one jump

/// Pictures that are in memory, as a recording.
class KeptFrames final : public FrameSource {
 public:
  KeptFrames(const std::vector<const Picture*>& pictures, const std::vector<Time>& captured)
      : pictures_(pictures), captured_(captured) {}

  std::span<const Time> captured() const override { return captured_; }
  Size picture_size() const override { return pictures_.front()->size; }
  std::optional<FrameStamp> next() override {
    if (next_ == captured_.size()) return {};
    const std::size_t frame = next_++;
    return FrameStamp{static_cast<FrameIndex>(frame), captured_[frame]};
  }
  Image image() override { return pictures_[next_ - 1]->view(); }

 private:
  const std::vector<const Picture*>& pictures_;
  const std::vector<Time>& captured_;
  std::size_t next_ = 0;
};

/// The pictures of one window after the other: no more are held.
class Window {
 public:
  explicit Window(const Sequence& sequence) : source_(sequence.frames()) {}

  /// Reads the frames from `start` on; windows come in order.
  void move_to(std::size_t start, std::size_t frames) {
    if (!pictures_.empty() && start == start_) return;
    pictures_.clear();
    for (; pictures_.size() < frames && source_->next(); ++next_)
      if (next_ >= start) pictures_.push_back(source_->image());
    start_ = start;
  }
  const Picture& at(std::size_t frame) const { return pictures_.at(frame - start_); }

 private:
  std::unique_ptr<FrameSource> source_;
  std::size_t next_ = 0, start_ = 0;
  std::vector<Picture> pictures_;
};

Outcome outcome_of(const Scene& scene, const Trajectory& trajectory) {
  const auto judged = [&](std::size_t frame) {
    return judge_frame(scene.recording, frame, trajectory.frames[frame], trajectory, {}).targets.front();
  };
  const bool given = scene.held == 0;  // the gap follows the start at once
  if (!given && !judged(scene.held).hold) return Outcome::not_held;
  const Judgement last = judged(scene.judged);
  if (last.hold) return Outcome::held;
  if (last.failed) return Outcome::failed;
  return last.verdict == Verdict::Miss ? Outcome::declared : Outcome::silent;
}

Outcome try_jump(const Trial& trial, const ChosenMethod& method, const Sequence& sequence, const Jump& jump,
                 const Window& window) {
  const Scene scene = scene_of(sequence.recording, jump, trial.test, trial.clock);
  std::vector<const Picture*> pictures;
  for (const std::size_t frame : scene.frames) pictures.push_back(&window.at(frame));
  Schedule schedule(scene.frames.size());
  for (const std::size_t frame : scene.missing) schedule.drop(frame);
  KeptFrames frames(pictures, scene.recording.captured);
  ReplayOptions options;
  options.protocol = method.takes_boxes ? Protocol::once : Protocol::detect;
  options.reads_codes = method.reads_codes;
  const auto asked = method.make(scene.recording, trial.seed);
  return outcome_of(scene, replay(*asked, frames, scene.recording, schedule, options).trajectory);
}

/// One method on one sequence, from its jump `first` on. Tells each jump's outcome.
void try_from(const Trial& trial, std::size_t method, std::size_t sequence, std::size_t first,
              const Tell& tell) {
  Window window(trial.sequences[sequence]);
  const auto frames = static_cast<std::size_t>(trial.test.window());
  const std::vector<Jump>& jumps = trial.jumps[sequence];
  for (std::size_t rank = first; rank < jumps.size(); ++rank) {
    window.move_to(static_cast<std::size_t>(jumps[rank].start), frames);
    const Outcome outcome =
        try_jump(trial, trial.methods[method], trial.sequences[sequence], jumps[rank], window);
    tell(fmt::format("{}", static_cast<int>(outcome)));
  }
}

/// One method on one sequence, in child processes: a new one goes on behind a jump at which one died.
class Attempt {
 public:
  Attempt(const Trial& trial, std::size_t method, std::size_t sequence, std::vector<Outcome>& outcomes)
      : trial_(trial), method_(method), sequence_(sequence), outcomes_(outcomes) {
    begin();
  }

  const Child& child() const { return *child_; }
  /// Whether all jumps have been tried.
  bool look() {
    for (const std::string& message : child_->take())
      outcomes_.push_back(static_cast<Outcome>(std::stoi(message)));
    const auto end = child_->end();
    if (!end) return false;
    if (end->kind == ChildEnd::Kind::threw) throw Error(end->what);
    if (end->kind != ChildEnd::Kind::finished) outcomes_.push_back(Outcome::failed);
    if (outcomes_.size() >= trial_.jumps[sequence_].size()) return true;
    begin();
    return false;
  }

 private:
  void begin() {
    const std::size_t first = outcomes_.size();
    child_ = std::make_unique<Child>(
        [this, first](const Tell& tell) { try_from(trial_, method_, sequence_, first, tell); },
        ChildLimits{.silence = kPatience});
  }

  const Trial& trial_;
  std::size_t method_, sequence_;
  std::vector<Outcome>& outcomes_;
  std::unique_ptr<Child> child_;
};

}  // namespace

bool lost(Outcome outcome) { return outcome != Outcome::not_held && outcome != Outcome::held; }

Outcomes try_all(const Trial& trial, int jobs) {
  const std::size_t sequences = trial.sequences.size(), count = trial.methods.size() * sequences;
  Outcomes outcomes(trial.methods.size(), std::vector<std::vector<Outcome>>(sequences));
  std::vector<std::unique_ptr<Attempt>> busy;
  Progress progress("jumping", static_cast<std::int64_t>(count));
  std::size_t next = 0;
  while (next < count || !busy.empty()) {
    for (; next < count && busy.size() < static_cast<std::size_t>(jobs); ++next) {
      const std::size_t method = next / sequences, sequence = next % sequences;
      busy.push_back(std::make_unique<Attempt>(trial, method, sequence, outcomes[method][sequence]));
    }
    std::vector<const Child*> children;
    for (const auto& attempt : busy) children.push_back(&attempt->child());
    Child::wait_for_any(children, std::chrono::seconds(1));
    std::erase_if(busy, [](const auto& attempt) { return attempt->look(); });
    progress.done(static_cast<std::int64_t>(next - busy.size()));
  }
  return outcomes;
}

}  // namespace relock::jumps
