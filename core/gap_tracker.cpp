// gap_aware and blur_predict of core/compose.h: a tracker that is told where its target is after a gap.

#include <algorithm>
#include <utility>

#include "core/compose.h"
#include "core/error.h"
#include "core/motion_memory.h"

namespace relock {
namespace {

constexpr double kOldPlace = 0.1;     // sizes around the last box that count as the old place
constexpr double kSigmas = 3;         // of the prediction that are searched
constexpr double kMostSpread = 1.0;   // sizes: beyond, a prediction says nothing any more
constexpr double kLeastReach = 0.25;  // sizes searched around a prediction in any case

enum class Speedometer : std::uint8_t { positions, blur };

Box grown(const Box& box, double by) {
  return {box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

class GapTracker final : public Tracker {
 public:
  GapTracker(TrackerFactory make_tracker, Hints hints, std::unique_ptr<Searcher> searcher,
             Speedometer speedometer, BlurMeter meter, const GapOptions& options)
      : make_tracker_(std::move(make_tracker)),
        hints_(hints),
        searcher_(std::move(searcher)),
        speedometer_(speedometer),
        meter_(std::move(meter)),
        options_(options),
        tracker_(make_tracker_(0)) {}

  void start(const Frame& frame, const Box& box) override {
    tracker_->start(frame, box);
    size_ = frame.image.size();
    memory_.show(frame.captured);
    remember(frame, box, {});
  }

  std::optional<Sighting> track(const Frame& frame) override {
    memory_.show(frame.captured);
    auto said = memory_.after_gap() ? track_after_gap(frame) : tracker_->track(frame);
    if (said) remember(frame, bounds(said->outline), said->blur);
    return said;
  }

  void expect(const Box& prior, double sigma_px) override { tracker_->expect(prior, sigma_px); }

 private:
  struct Prior {
    Box box;
    double sigma_px;
  };

  void remember(const Frame& frame, const Box& box, std::optional<BlurEstimate> blur) {
    if (!blur && meter_) blur = meter_(frame.image, box);
    memory_.see(box, blur);
    if (hints_ == Hints::ignored) searcher_->remember(frame.image, box);
  }

  std::optional<Sighting> track_after_gap(const Frame& frame) {
    const auto prior = predicted();
    if (!prior) return tracker_->track(frame);
    if (hints_ == Hints::honoured) {
      tracker_->expect(prior->box, prior->sigma_px);
    } else if (frame.image.size() == size_) {
      if (auto found = started_elsewhere(frame, *prior)) return found;
    }
    return tracker_->track(frame);
  }

  std::optional<Prior> predicted() const {
    auto velocity = memory_.velocity();
    if (!velocity) return std::nullopt;
    if (speedometer_ == Speedometer::blur)
      velocity = memory_.velocity_by_blur(options_.exposure_s).value_or(*velocity);
    const Box box = memory_.moved(*velocity);
    const double spread = std::min(options_.spread * memory_.missing_periods(), kMostSpread);
    return Prior{box, spread * size_of(box)};
  }

  /// The answer of a new tracker, if the target is plainly not where the old one would look first.
  std::optional<Sighting> started_elsewhere(const Frame& frame, const Prior& prior) {
    const Box old = *memory_.last_box();
    const double size = size_of(old);
    const Box picture = picture_box(frame.image.size());
    const double reach = std::max(kSigmas * prior.sigma_px, kLeastReach * size);
    const auto there = searcher_->find(frame.image, intersect(grown(prior.box, reach), picture));
    if (!there) return std::nullopt;
    const auto here = searcher_->find(frame.image, intersect(grown(old, kOldPlace * size), picture));
    if (here && there->likeness < here->likeness + options_.margin) return std::nullopt;
    auto fresh = make_tracker_(starts_);
    try {
      fresh->start(frame, there->box);
    } catch (const Error&) {  // it cannot start there, at the picture's edge say
      return std::nullopt;
    }
    ++starts_;
    tracker_ = std::move(fresh);
    Sighting sighting = sighting_of(there->box);
    sighting.confidence = std::clamp(there->likeness, 0.0, 1.0);
    return sighting;
  }

  TrackerFactory make_tracker_;
  Hints hints_;
  std::unique_ptr<Searcher> searcher_;
  Speedometer speedometer_;
  BlurMeter meter_;
  GapOptions options_;
  std::unique_ptr<Tracker> tracker_;
  std::uint64_t starts_ = 1;
  Size size_;
  MotionMemory memory_;
};

}  // namespace

std::unique_ptr<Tracker> gap_aware(TrackerFactory make_tracker, Hints hints,
                                   std::unique_ptr<Searcher> searcher, const GapOptions& options) {
  return std::make_unique<GapTracker>(std::move(make_tracker), hints, std::move(searcher),
                                      Speedometer::positions, BlurMeter(), options);
}

std::unique_ptr<Tracker> blur_predict(TrackerFactory make_tracker, Hints hints,
                                      std::unique_ptr<Searcher> searcher, BlurMeter meter,
                                      const GapOptions& options) {
  return std::make_unique<GapTracker>(std::move(make_tracker), hints, std::move(searcher), Speedometer::blur,
                                      std::move(meter), options);
}

BlurMeter blur_of_detections(std::shared_ptr<Detector> detector) {
  return [detector = std::move(detector)](const Image& image, const Box& box) {
    std::optional<BlurEstimate> blur;
    double nearest = 0.5 * size_of(box);
    for (const Sighting& seen : detector->detect(image, box)) {
      const double apart = norm(centre_of(seen.outline) - centre_of(box));
      if (apart <= nearest && seen.blur) nearest = apart, blur = seen.blur;
    }
    return blur;
  };
}

}  // namespace relock
