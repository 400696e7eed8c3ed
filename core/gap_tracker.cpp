// gap_aware and blur_predict of core/compose.h: a tracker that is told where its target is after a gap.

#include <algorithm>
#include <utility>
#include <vector>

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
        tracker_(make_tracker_(0)),
        memory_(options.period_s, options.exposure_s) {}

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
    const auto priors = predicted();
    if (hints_ == Hints::honoured) {
      const Prior hint = over_all(priors);
      tracker_->expect(hint.box, hint.sigma_px);
    } else if (frame.image.size() == size_) {
      if (auto found = started_elsewhere(frame, priors)) return found;
    }
    return tracker_->track(frame);
  }

  /// One, or two where a blur has no sign; none at all is known where the target is taken to stay.
  std::vector<Vec2> velocities() const {
    const auto by_answers = memory_.velocity();
    const bool ask_blur =
        speedometer_ == Speedometer::blur &&
        (!by_answers || memory_.blur_tells_better().value_or(options_.exposure_s.has_value()));
    std::vector<Vec2> velocities;
    if (ask_blur) velocities = memory_.velocities_by_blur();
    if (velocities.empty()) velocities = {by_answers.value_or(Vec2{})};
    return velocities;
  }

  std::vector<Prior> predicted() const {
    std::vector<Prior> priors;
    const double spread = std::min(options_.spread * memory_.missing_periods(), kMostSpread);
    for (const Vec2 velocity : velocities()) {
      const Box box = memory_.moved(velocity);
      priors.push_back({box, spread * size_of(box)});
    }
    return priors;
  }

  /// The one prior, or the old place, as uncertain as both are far from it.
  Prior over_all(const std::vector<Prior>& priors) const {
    if (priors.size() == 1) return priors.front();
    const Box old = *memory_.last_box();
    return {old, norm(centre_of(priors.front().box) - centre_of(old)) + priors.front().sigma_px};
  }

  /// The place that looks most alike around any of the priors.
  std::optional<Searcher::Found> most_alike(const Frame& frame, const std::vector<Prior>& priors, double size,
                                            const Box& picture) {
    std::optional<Searcher::Found> best;
    for (const Prior& prior : priors) {
      const double reach = std::max(kSigmas * prior.sigma_px, kLeastReach * size);
      const auto found = searcher_->find(frame.image, intersect(grown(prior.box, reach), picture));
      if (found && (!best || found->likeness > best->likeness)) best = found;
    }
    return best;
  }

  /// The answer of a new tracker, if the target is plainly not where the old one would look first.
  std::optional<Sighting> started_elsewhere(const Frame& frame, const std::vector<Prior>& priors) {
    const Box old = *memory_.last_box();
    const double size = size_of(old);
    const Box picture = picture_box(frame.image.size());
    const auto there = most_alike(frame, priors, size, picture);
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
    // A tracker's box may lag behind its target, and the target's smear is longer than the target.
    double nearest = 0.5 * size_of(box);
    for (const Sighting& seen : detector->detect(image, grown(box, nearest))) {
      const double apart = norm(centre_of(seen.outline) - centre_of(box));
      if (apart <= nearest && seen.blur) nearest = apart, blur = seen.blur;
    }
    return blur;
  };
}

}  // namespace relock
