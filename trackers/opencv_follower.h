#pragma once

#include <opencv2/video/tracking.hpp>

#include "core/opencv.h"
#include "trackers/checked_tracker.h"
#include "trackers/start_box.h"

namespace relock {

/// A tracker of OpenCV's present interface, cv::Tracker: whole pixels in, whole pixels out.
template <class LibraryTracker>
class OpencvFollower : public Follower {
 public:
  explicit OpencvFollower(cv::Ptr<LibraryTracker> library) : library_(std::move(library)) {}

  void start(const Image& picture, const Box& box) override {
    library_->init(bgr_copy(picture, bgr_), whole_pixels(box, picture.size()));
  }

  std::optional<Sighting> follow(const Image& picture) override {
    cv::Rect rect;
    // The trackers want BGR throughout, and some write into what they are given.
    if (!library_->update(bgr_copy(picture, bgr_), rect) || rect.empty()) return std::nullopt;
    return sighting_of(box_of(rect));
  }

 protected:
  LibraryTracker& library() { return *library_; }

 private:
  cv::Ptr<LibraryTracker> library_;
  cv::Mat bgr_;
};

}  // namespace relock
