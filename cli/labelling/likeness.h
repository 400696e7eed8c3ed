#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <thread>
#include <vector>

#include "cli/labelling/desk.h"
#include "core/frame_source.h"

namespace relock {

/// What a picture shows under an outline, in a size of its own.
cv::Mat look_at(const Image& picture, const Outline& outline);
/// Normalised correlation of two looks, in [-1, 1]: the same for any brightness and contrast. 0 where one is even.
double correlation(const cv::Mat& a, const cv::Mat& b);

/// Compares the picture under every label with that under the last placed key frame, in a thread of its own: for each
/// new state of the desk it reads the recording once.
class LikenessWatch {
 public:
  explicit LikenessWatch(std::function<std::unique_ptr<FrameSource>()> open);
  ~LikenessWatch();

  /// Begins anew with these labels.
  void look_at_labels(std::vector<KeyedTarget> targets, std::vector<FilledTarget> filled,
                      std::size_t version);
  /// As far as is known; NaN where it is not. Of the version that was asked for last.
  Likenesses known() const;
  /// Whether all of that is known.
  bool finished() const;

 private:
  struct Task {
    std::vector<KeyedTarget> targets;
    std::vector<FilledTarget> filled;
    std::size_t version = 0;
  };
  void work();
  void read_recording(const Task& task);
  bool outdated(const Task& task) const;

  std::function<std::unique_ptr<FrameSource>()> open_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::shared_ptr<const Task> task_;
  Likenesses known_;
  bool finished_ = true, ends_ = false;
  std::thread thread_;
};

}  // namespace relock
