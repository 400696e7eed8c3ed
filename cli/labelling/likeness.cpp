#include "cli/labelling/likeness.h"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

constexpr int kLook_px = 32;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

const KeyFrame* key_on(const KeyedTarget& target, std::size_t frame) {
  for (const KeyFrame& key : target.keys)
    if (key.frame == frame) return &key;
  return nullptr;
}

}  // namespace

cv::Mat look_at(const Image& picture, const Outline& outline) {
  cv::Mat buffer, cut, look;
  const Box box = bounds(outline);
  const cv::Mat gray = gray_of(picture, buffer);
  const cv::Size size(std::max(2, static_cast<int>(std::lround(box.width))),
                      std::max(2, static_cast<int>(std::lround(box.height))));
  const Vec2 centre = centre_of(box);
  cv::getRectSubPix(gray, size, cv::Point2f(static_cast<float>(centre.x), static_cast<float>(centre.y)), cut,
                    CV_32F);
  cv::resize(cut, look, {kLook_px, kLook_px}, 0, 0, cv::INTER_AREA);
  return look;
}

double correlation(const cv::Mat& a, const cv::Mat& b) {
  const cv::Mat x = a - cv::mean(a)[0], y = b - cv::mean(b)[0];
  const double both = std::sqrt(x.dot(x) * y.dot(y));
  return both > 0 ? x.dot(y) / both : 0;
}

LikenessWatch::LikenessWatch(std::function<std::unique_ptr<FrameSource>()> open)
    : open_(std::move(open)), thread_([this] { work(); }) {}

LikenessWatch::~LikenessWatch() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void LikenessWatch::look_at_labels(std::vector<KeyedTarget> targets, std::vector<FilledTarget> filled,
                                   std::size_t version) {
  {
    const std::lock_guard lock(mutex_);
    known_.clear();
    for (const FilledTarget& each : filled) known_.emplace_back(each.truth.size(), kUnknown);
    finished_ = false;
    task_ = std::make_shared<const Task>(Task{std::move(targets), std::move(filled), version});
  }
  wake_.notify_all();
}

Likenesses LikenessWatch::known() const {
  const std::lock_guard lock(mutex_);
  return known_;
}

bool LikenessWatch::finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

bool LikenessWatch::outdated(const Task& task) const { return ends_ || task_.get() != &task; }

void LikenessWatch::work() {
  for (;;) {
    std::shared_ptr<const Task> task;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return ends_ || !finished_; });
      if (ends_) return;
      task = task_;
    }
    try {
      read_recording(*task);
    } catch (const Error&) {
      // A picture that cannot be read is told of when it is shown.
    }
    const std::lock_guard lock(mutex_);
    if (task_ == task) finished_ = true;
  }
}

void LikenessWatch::read_recording(const Task& task) {
  const auto source = open_();
  std::vector<cv::Mat> last(task.targets.size());
  for (std::size_t frame = 0; source->next(); ++frame) {
    std::vector<double> found(task.targets.size(), kUnknown);
    for (std::size_t t = 0; t < task.targets.size(); ++t) {
      const TargetTruth& truth = task.filled[t].truth[frame];
      if (truth.label != Label::visible) continue;
      const cv::Mat look = look_at(source->image(), *truth.outline);
      if (!last[t].empty()) found[t] = correlation(look, last[t]);
      const KeyFrame* key = key_on(task.targets[t], frame);
      if (key != nullptr && key->state == KeyState::placed) last[t] = look;
    }
    const std::lock_guard lock(mutex_);
    if (outdated(task)) return;
    for (std::size_t t = 0; t < found.size(); ++t) known_[t][frame] = found[t];
  }
}

}  // namespace relock
