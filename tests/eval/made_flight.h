#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/frame_source.h"
#include "core/method.h"
#include "core/recording.h"
#include "eval/trajectory.h"

namespace relock {

/// A recording of one target, 40 px, that moves 1 px a frame to the right, one frame a letter at 30 Hz:
/// v visible, a absent, ? unlabelled, o visible but largely occluded.
Recording made_flight(const std::string& letters);

/// What a method said of its target: g given, H right, S beside it by `aside`, M silent, . dropped.
Trajectory said(const Recording& recording, const std::string& letters, Vec2 aside = {200, 0});

/// The letters of the verdicts on one target, of every recorded frame.
std::string verdicts(const Recording& recording, const Trajectory& trajectory, std::size_t target = 0);

/// Its frames: blank pictures of 640x360. `unreadable_from`: the first one that cannot be read, or -1.
class MadeFrames final : public FrameSource {
 public:
  explicit MadeFrames(const Recording& recording, FrameIndex unreadable_from = -1);
  std::span<const Time> captured() const override { return recording_.captured; }
  Size picture_size() const override { return recording_.picture; }
  std::optional<FrameStamp> next() override;
  Image image() override;

 private:
  const Recording& recording_;
  FrameIndex unreadable_from_;
  FrameIndex at_ = -1;
  std::vector<std::uint8_t> pixels_;
};

/// A method that says what `say` says, and remembers on which frames it was started and asked.
class Scripted final : public Method {
 public:
  enum class Boxes : std::uint8_t { taken, not_taken };

  explicit Scripted(std::function<Sightings(const Frame&)> say, Boxes boxes = Boxes::taken)
      : say_(std::move(say)), boxes_(boxes) {}
  bool takes_boxes() const override { return boxes_ == Boxes::taken; }
  void start(const Frame& frame, const Target&, const Box& box) override {
    started.push_back(frame.index);
    given = box;
  }
  Sightings locate(const Frame& frame) override {
    asked.push_back(frame.index);
    return say_(frame);
  }

  std::vector<FrameIndex> started, asked;
  Box given;

 private:
  std::function<Sightings(const Frame&)> say_;
  Boxes boxes_;
};

/// What a Scripted says that is silent.
inline Sightings nothing(const Frame&) { return {}; }

}  // namespace relock
