#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/detector.h"
#include "core/method.h"
#include "core/tracker.h"

// Methods made of detectors and trackers. A new way to combine them is a new builder, not a new flag. On the
// command line they are detect(D), track(T), hybrid(D,T), guarded(T,D), gap-aware(T) and blur-predict(T[,D])
// (docs/combining.md).
//
// Times are the frames' own: a gap is more than 1.5 nominal periods since the last frame that was shown, and the
// nominal period is estimated from the frames shown so far where it is not given. Places that are apart are measured
// in sizes of the target (core/geometry.h, size_of).

namespace relock {

/// Detection in every frame, on its own; takes no boxes.
std::unique_ptr<Method> detect_every_frame(std::unique_ptr<Detector> detector);

/// A new tracker; `start_number` counts the starts of a run from 0, so that each may draw its own random
/// numbers.
using TrackerFactory = std::function<std::unique_ptr<Tracker>(std::uint64_t start_number)>;

/// One tracker for each target, from the given box, each start with a new tracker. Its sightings carry their
/// target's id.
std::unique_ptr<Method> track_from_box(TrackerFactory make_tracker);

struct HybridOptions {
  double doubt = 0;       ///< a tracker less confident than this is not believed, and the detector asked
  int every = 1;          ///< frames from one look of the detector to the next, while nothing is in doubt
  double patience_s = 1;  ///< how long a target whose box nobody gave is followed without being detected
};

/// Detection where it succeeds, tracking in between. A detection is the answer, and a new tracker starts from
/// it; where there is none the tracker answers. A tracker that is silent or less confident than `doubt` is in doubt: the
/// detector looks in this very frame, and if it finds nothing, nothing is said. It looks after a gap, too.
///
/// Which detection is which target: the one that reads the target's code; else, one to one, the nearest whose
/// code does not contradict, within 2 sizes of the last place, or anywhere once the last answer was nothing.
///
/// It works with a given box and without one. With one it follows the targets that it was given, and passes on
/// other detections as they are. Without one every detection is followed, under no id.
std::unique_ptr<Method> hybrid(std::unique_ptr<Detector> detector, TrackerFactory make_tracker,
                               const HybridOptions& options = {});

struct GuardedOptions {
  int every = 10;    ///< frames from one look of the detector to the next, while nothing is in doubt
  double doubt = 0;  ///< a tracker less confident than this makes the detector look at once; so does silence
  double patience_s = 1;  ///< unconfirmed for longer is lost
  double apart = 0.25;    ///< sizes: a detection that is farther from the tracker's answer corrects it
};

/// A tracker that a detector watches. The tracker leads, from a given box; the detector looks every `every`
/// frames, on doubt and after a gap. Seen near the tracker's answer the target is confirmed; seen elsewhere the detection is
/// the answer and a new tracker starts from it. A target that was not confirmed for `patience_s` is lost:
/// nothing is said until the detector, which now looks in every frame, finds it again. So no loss is silent for
/// longer than that, unless the detector errs, too.
std::unique_ptr<Method> guarded(TrackerFactory make_tracker, std::unique_ptr<Detector> detector,
                                const GuardedOptions& options = {});

/// Finds a target by its look: what a tracker that takes no hints is helped with. Core has none;
/// trackers/patch_searcher.h does.
class Searcher {
 public:
  struct Found {
    Box box;
    double likeness = 0;  ///< in [0, 1]; 1: looks the same
  };
  virtual ~Searcher() = default;
  /// The target is at `box` in `image`: this is how it looks now.
  virtual void remember(const Image& image, const Box& box) = 0;
  /// The place whose box lies within `region` that looks most like it; nothing if there is none.
  virtual std::optional<Found> find(const Image& image, const Box& region) = 0;
};

/// How a target at `box` in `image` is blurred; nothing: not told.
using BlurMeter = std::function<std::optional<BlurEstimate>(const Image& image, const Box& box)>;

/// What a detector says of the target at that place: the blur of its nearest sighting, within half a size.
BlurMeter blur_of_detections(std::shared_ptr<Detector> detector);

/// Whether Tracker::expect changes what a tracker does (its registry entry says so).
enum class Hints : std::uint8_t { honoured, ignored };

struct GapOptions {
  double spread = 0.1;  ///< sizes: how uncertain a predicted place is, for each period that is missing
  double margin = 0.1;  ///< how much more alike than the old place a new one must look to start there
  std::optional<double> period_s = {};    ///< nominal; empty: estimated from the frames, from the third on
  std::optional<double> exposure_s = {};  ///< blur_predict only; empty: learned from the frames
};

/// A tracker that knows the time since the last frame. After a gap it is told (Tracker::expect) where the
/// target is thought to be: at constant velocity, from the last two answers over their true times, give or take `spread`
/// sizes for each missing period. A tracker that ignores hints has its target looked for there by `searcher`:
/// when another place looks more alike than the old one by `margin`, a new tracker starts there. Where no velocity is
/// known, right after a start, it is looked for about the old place.
///
/// Where no frame is missing it does what its tracker does, to the bit.
std::unique_ptr<Tracker> gap_aware(TrackerFactory make_tracker, Hints hints,
                                   std::unique_ptr<Searcher> searcher, const GapOptions& options = {});

/// Likewise, but the blur is the speedometer: its length over the exposure is the speed, along the blur's
/// line; the last two answers say which way. So the newest frame alone tells how fast the target went when the gap began;
/// velocity from two answers is half an interval older, and more after a gap.
///
/// With a period T and an exposure E the target moves kappa = T / E lengths of blur a period. E is
/// `exposure_s`, or kappa is learned: the median of displacement over length of blur, over the frames without a gap
/// (the last 64 with a blur of 2 px or more). That needs no metadata, and takes up what the blur's
/// estimator does wrong in proportion. Until 5 are seen kappa is 2: an exposure of half a period.
///
/// Estimates of blur may be poor. So the blur must have told better than the answers did: the medians of both
/// errors, over the same steps from frame to frame. Until 5 steps are seen it is believed if E is given.
///
/// Where the answers do not tell which way (right after a start there is one; some trackers stand still in their
/// first frame), the target is looked for on both sides: a tracker that honours hints is told the old place with the
/// distance as uncertainty. At the first frame after the start the nominal period must be given, else no gap is
/// known for one.
///
/// The blur is the tracker's own (Sighting::blur), else what `meter` says. Where neither says any
/// it is gap_aware.
std::unique_ptr<Tracker> blur_predict(TrackerFactory make_tracker, Hints hints,
                                      std::unique_ptr<Searcher> searcher, BlurMeter meter,
                                      const GapOptions& options = {});

}  // namespace relock
