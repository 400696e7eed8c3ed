#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/compose.h"

// Trackers and detectors that say what a script tells them, and frames without pixels.

namespace relock {

constexpr Duration kPeriod{33'333'333};

/// A frame of one grey pixel, on the clock of 30 Hz.
inline Frame frame_at(FrameIndex index) {
  static const std::uint8_t pixel = 0;
  return {index, Time{index * kPeriod}, Image(&pixel, {1, 1}, PixelFormat::gray8, 1)};
}

inline Box box_at(double x) { return {x - 10, 40, 20, 20}; }

inline Sighting seen_at(double x, const std::optional<Code>& code = {}, double confidence = 1) {
  Sighting sighting = sighting_of(box_at(x));
  sighting.code = code;
  sighting.confidence = confidence;
  return sighting;
}

/// Says what the script says of the frame's index and of the box that it was started from.
class ScriptedTracker final : public Tracker {
 public:
  using Script = std::function<std::optional<Sighting>(FrameIndex, const Box& from)>;
  struct Log {
    std::vector<FrameIndex> starts;
    std::vector<std::pair<Box, double>> expected;
  };
  ScriptedTracker(Script script, std::shared_ptr<Log> log)
      : script_(std::move(script)), log_(std::move(log)) {}
  void start(const Frame& frame, const Box& box) override {
    from_ = box;
    log_->starts.push_back(frame.index);
  }
  std::optional<Sighting> track(const Frame& frame) override { return script_(frame.index, from_); }
  void expect(const Box& prior, double sigma_px) override { log_->expected.emplace_back(prior, sigma_px); }

 private:
  Script script_;
  std::shared_ptr<Log> log_;
  Box from_;
};

inline TrackerFactory scripted(ScriptedTracker::Script script, std::shared_ptr<ScriptedTracker::Log> log) {
  return [=](std::uint64_t) { return std::make_unique<ScriptedTracker>(script, log); };
}

/// Says what the script says whenever it looks.
class ScriptedDetector final : public Detector {
 public:
  explicit ScriptedDetector(std::function<Sightings()> script) : script_(std::move(script)) {}
  Sightings detect(const Image&, const std::optional<Box>&) override { return script_(); }

 private:
  std::function<Sightings()> script_;
};

}  // namespace relock
