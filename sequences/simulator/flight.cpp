#include "sequences/simulator/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "core/random.h"
#include "sequences/description.h"
#include "sequences/gaps.h"
#include "sequences/simulator/flight_writer.h"
#include "sequences/simulator/preview.h"
#include "sequences/simulator/render.h"

namespace relock::simulator {
namespace {

enum Key : std::uint64_t { kScene = 1, kMotion, kJitter, kNoise, kGaps };

std::uint64_t seed_of(const FlightPlan& plan, Key key) { return Random(plan.seed).fork(key).next(); }

/// Middles of all exposures, kept or lost.
std::vector<Time> exposure_times(const FlightPlan& plan) {
  const double period = 1 / plan.camera.rate_hz;
  const auto frames =
      static_cast<std::int64_t>(std::max(1.0, std::floor(plan.duration_s * plan.camera.rate_hz + 1e-9)));
  Random random(seed_of(plan, kJitter));
  std::vector<Time> times;
  times.reserve(static_cast<std::size_t>(frames));
  for (std::int64_t i = 0; i < frames; ++i) {
    const double off =
        std::clamp(plan.timing.jitter_ms / 1000 * random.normal(), -0.4 * period, 0.4 * period);
    times.push_back(Time{from_seconds((static_cast<double>(i) + 0.5) * period + off)});
  }
  return times;
}

/// Ranks, among all exposures, of those that are recorded.
std::vector<std::int64_t> recorded(const FlightPlan& plan, const std::vector<Time>& times) {
  const Schedule schedule = GapPattern::parse(plan.timing.gaps)
                                .apply(times, period_of(plan.camera.rate_hz), seed_of(plan, kGaps), {});
  std::vector<std::int64_t> ranks;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (schedule.delivered(i)) ranks.push_back(static_cast<std::int64_t>(i));
  if (ranks.empty()) throw Error(fmt::format("gaps {} leave no frame of this flight", plan.timing.gaps));
  return ranks;
}

Camera camera_of(const CameraPlan& plan) {
  Camera camera;
  if (plan.width != std::floor(plan.width) || plan.height != std::floor(plan.height))
    throw Error("camera: width and height are whole numbers");
  camera.picture = {static_cast<int>(plan.width), static_cast<int>(plan.height)};
  camera.focal_px = focal_of_diagonal(camera.picture, plan.diagonal_deg);
  camera.k1 = plan.k1, camera.k2 = plan.k2;
  check_camera(camera);
  return camera;
}

std::vector<PrintedTarget> print(const FlightPlan& plan, const TargetResolver& target_of) {
  std::vector<PrintedTarget> printed;
  for (const PlannedTarget& target : plan.targets) printed.push_back(target_of(target.name, target.size_m));
  return printed;
}

std::vector<Target> targets_of(const Scene& scene) {
  std::vector<Target> targets;
  for (const HungTarget& target : scene.targets)
    targets.push_back({target.id, target.printed.code, target.printed.size_m});
  return targets;
}

/// The frames of one flight, made by several threads and written down in order.
class Film {
 public:
  Film(const FlightPlan& plan, const Scene& scene, const Camera& camera, FlightWriter& writer,
       const FlightOptions& options)
      : plan_(plan),
        options_(options),
        scene_(scene),
        camera_(camera),
        motion_(plan.motion, seed_of(plan, kMotion),
                plan.scene.arrangement == Arrangement::box ? plan.scene.box_side_m / 2 : 0),
        renderer_(scene, camera),
        writer_(writer),
        times_(exposure_times(plan)),
        ranks_(recorded(plan, times_)) {
    if (plan.transport.h264_kbps > 0)
      link_.emplace(camera.picture, plan.camera.rate_hz, plan.transport.h264_kbps);
    if (options.preview) preview_.emplace(*options.preview, camera.picture, plan.camera.rate_hz);
  }

  FlightSummary make(int jobs) {
    std::vector<std::thread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    if (fault_) std::rethrow_exception(fault_);
    if (preview_) preview_->finish();
    summary_.frames = static_cast<std::int64_t>(ranks_.size());
    summary_.lost = static_cast<std::int64_t>(times_.size() - ranks_.size());
    summary_.mean_motion_px /= static_cast<double>(ranks_.size());
    return summary_;
  }

 private:
  struct Scratch {
    cv::Mat light, picture;
    std::vector<unsigned char> bytes;
  };

  void work() {
    Scratch scratch;
    try {
      for (std::int64_t frame = next_++; frame < static_cast<std::int64_t>(ranks_.size()); frame = next_++)
        make_frame(frame, scratch);
    } catch (...) {
      const std::lock_guard lock(turn_);
      if (!fault_) fault_ = std::current_exception();
      turned_.notify_all();
    }
  }

  void make_frame(std::int64_t frame, Scratch& scratch) {
    const std::int64_t rank = ranks_[static_cast<std::size_t>(frame)];
    const Time captured = times_[static_cast<std::size_t>(rank)];
    const Exposure exposure(plan_.exposure, motion_, seconds(captured), seconds(captured) / plan_.duration_s);
    FlownFrame flown{captured, exposure.duration_s(), exposure.gain(), renderer_.motion_px(exposure), 1, {}};
    flown.steps = Renderer::steps_for(flown.motion_px, plan_.exposure);
    flown.truth = truth_of_frame(scene_, camera_, exposure, flown.steps);
    renderer_.render(exposure, flown.steps, scratch.light);
    if (exposure.light() != 1) scratch.light.convertTo(scratch.light, -1, exposure.light());
    develop(scratch.light, plan_.sensor, exposure.gain(),
            Random(seed_of(plan_, kNoise)).fork(static_cast<std::uint64_t>(rank)).next(), scratch.picture);
    in_turn(frame, [&] { take(frame, flown, scratch.picture); });
    encode_picture(scratch.picture, plan_.transport, scratch.bytes);
    writer_.write_picture(frame, scratch.bytes);
  }

  /// Frames come here one after another, whatever thread made them.
  template <class Step>
  void in_turn(std::int64_t frame, const Step& step) {
    std::unique_lock lock(turn_);
    turned_.wait(lock, [&] { return turn_of_ == frame || fault_; });
    if (fault_) return;
    step();
    ++turn_of_;
    turned_.notify_all();
  }

  void take(std::int64_t frame, const FlownFrame& flown, cv::Mat& picture) {
    writer_.add(flown);
    if (link_) link_->carry(picture, picture);
    if (preview_) preview_->add(picture, flown.captured);
    summary_.mean_motion_px += flown.motion_px;
    const double step = flown.steps > 1 ? flown.motion_px / flown.steps : 0;
    if (flown.steps == plan_.exposure.most_steps && step > 1.05 * plan_.exposure.step_px) {
      ++summary_.capped;
      summary_.coarsest_step_px = std::max(summary_.coarsest_step_px, step);
    }
    if (options_.progress) options_.progress(frame + 1);
  }

  const FlightPlan& plan_;
  const FlightOptions& options_;
  const Scene& scene_;
  const Camera camera_;
  const Motion motion_;
  const Renderer renderer_;
  FlightWriter& writer_;
  const std::vector<Time> times_;
  const std::vector<std::int64_t> ranks_;
  std::optional<VideoLink> link_;
  std::optional<PreviewWriter> preview_;

  std::atomic<std::int64_t> next_ = 0;
  std::mutex turn_;
  std::condition_variable turned_;
  std::int64_t turn_of_ = 0;
  std::exception_ptr fault_;
  FlightSummary summary_;
};

}  // namespace

std::int64_t frames_of(const FlightPlan& plan) {
  return static_cast<std::int64_t>(recorded(plan, exposure_times(plan)).size());
}

FlightSummary fly(const FlightPlan& plan, const TargetResolver& target_of, const std::filesystem::path& out,
                  const FlightOptions& options) {
  check_flight_plan(plan);
  const Camera camera = camera_of(plan.camera);
  const Scene scene = build_scene(plan.scene, print(plan, target_of), seed_of(plan, kScene));
  FlightWriter writer(out, targets_of(scene), std::string(picture_suffix(plan.transport)));
  Film film(plan, scene, camera, writer, options);
  const FlightSummary summary = film.make(std::max(1, options.jobs));
  Recording recording;
  recording.name = folder_name(out);
  recording.picture = camera.picture;
  recording.period = period_of(plan.camera.rate_hz);
  recording.targets = targets_of(scene);
  writer.finish(recording, flight_plan_text(plan), calibration_text(camera_of(plan.camera)));
  return summary;
}

}  // namespace relock::simulator
