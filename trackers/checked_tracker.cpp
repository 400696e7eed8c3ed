#include "trackers/checked_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "trackers/start_box.h"

namespace relock {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Calls the library; what it throws becomes one sentence about `tracker`. Not only cv::Exception: MIL throws
/// std::bad_alloc.
template <class Call>
auto guarded(const std::string& tracker, const char* doing, const Call& call) {
  try {
    return call();
  } catch (const Error&) {
    throw;
  } catch (const cv::Exception& fault) {
    throw Error(fmt::format("{} could not {}: OpenCV says \"{}\"", tracker, doing, one_line(fault.err)));
  } catch (const std::exception& fault) {
    throw Error(
        fmt::format("{} could not {}: the library says \"{}\"", tracker, doing, one_line(fault.what())));
  }
}

class CheckedTracker final : public Tracker {
 public:
  CheckedTracker(std::string name, const std::function<std::unique_ptr<Follower>()>& make)
      : name_(std::move(name)), follower_(guarded(name_, "be made", make)) {}

  void start(const Frame& frame, const Box& box) override {
    // A second init() on one KCF of OpenCV 4.6 corrupts memory.
    if (state_ != State::fresh)
      throw Error(fmt::format("{} was started already; a restart takes a new object", name_));
    const Box seen = startable_box(name_, frame.image, box);
    size_ = frame.image.size();
    last_captured_ = frame.captured;
    state_ = State::failed;
    guarded(name_, "start", [&] { follower_->start(frame.image, seen); });
    state_ = State::running;
  }

  std::optional<Sighting> track(const Frame& frame) override {
    check_running(frame);
    last_captured_ = frame.captured;
    state_ = State::failed;
    auto seen = guarded(name_, "go on", [&] { return follower_->follow(frame.image); });
    state_ = State::running;
    // A library may call a box found that is empty or lies outside of the picture.
    if (!seen || !well_formed(seen->outline) ||
        intersect(bounds(seen->outline), picture_box(size_)).area() <= 0)
      return std::nullopt;
    return seen;
  }

  void expect(const Box& prior, double sigma_px) override {
    if (state_ == State::running && well_formed(prior)) follower_->expect(prior, sigma_px);
  }

 private:
  enum class State { fresh, running, failed };

  void check_running(const Frame& frame) const {
    // OpenCV's update() before init() is a segmentation fault.
    if (state_ == State::fresh) throw Error(fmt::format("{} was given a frame before it was started", name_));
    if (state_ == State::failed) throw Error(fmt::format("{} has failed and takes no more frames", name_));
    const Size size = frame.image.size();
    if (frame.image.empty()) throw Error(fmt::format("{} was given an empty picture", name_));
    if (size != size_)
      throw Error(fmt::format("{} was started on pictures of {} x {} px and given one of {} x {} px", name_,
                              size_.width, size_.height, size.width, size.height));
    if (frame.captured < last_captured_)
      throw Error(fmt::format("{} was given a frame of {:.9f} s after one of {:.9f} s: time runs backwards",
                              name_, seconds(frame.captured), seconds(last_captured_)));
  }

  std::string name_;
  std::unique_ptr<Follower> follower_;
  State state_ = State::fresh;
  Size size_;
  Time last_captured_;
};

}  // namespace

std::unique_ptr<Tracker> checked_tracker(std::string name,
                                         const std::function<std::unique_ptr<Follower>()>& make) {
  return std::make_unique<CheckedTracker>(std::move(name), make);
}

}  // namespace relock
