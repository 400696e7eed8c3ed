#include "core/motion_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relock {
namespace {

constexpr std::size_t kFramesKept = 64;
constexpr std::size_t kLeastRatios = 5;
constexpr double kLeastBlurPx = 2;  // shorter ones are measured too coarsely to learn from
constexpr double kKappaAtFirst = 2;

double interval_in(Duration period, Time from, Time to) { return seconds(to - from) / seconds(period); }

}  // namespace

void MotionMemory::show(Time captured) {
  if (shown_.size() >= 2) period_ = nominal_period(std::vector<Time>(shown_.begin(), shown_.end()));
  shown_.push_back(captured);
  if (shown_.size() > kFramesKept) shown_.pop_front();
}

void MotionMemory::see(const Box& box, const std::optional<BlurEstimate>& blur) {
  if (shown_.empty()) return;
  before_ = std::exchange(last_, Seen{shown_.back(), box, blur});
  learn_kappa();
}

bool MotionMemory::after_gap() const {
  return period_ && shown_.size() >= 2 &&
         interval_in(*period_, shown_[shown_.size() - 2], shown_.back()) > kGap;
}

std::optional<Box> MotionMemory::last_box() const { return last_ ? std::optional(last_->box) : std::nullopt; }

double MotionMemory::missing_periods() const {
  if (!last_ || !period_) return 0;
  return std::max(0.0, interval_in(*period_, last_->at, shown_.back()) - 1);
}

std::optional<Vec2> MotionMemory::velocity() const {
  if (!before_ || last_->at <= before_->at) return std::nullopt;
  return 1 / seconds(last_->at - before_->at) * (centre_of(last_->box) - centre_of(before_->box));
}

std::optional<Vec2> MotionMemory::velocity_by_blur(const std::optional<double>& exposure_s) const {
  const auto way = velocity();
  if (!way || !period_ || !last_->blur) return std::nullopt;
  const BlurEstimate& blur = *last_->blur;
  const Vec2 along{std::cos(blur.direction_rad), std::sin(blur.direction_rad)};
  const double sign = dot(along, *way) < 0 ? -1 : 1;
  const double per_second =
      exposure_s ? 1 / *exposure_s : learned_kappa().value_or(kKappaAtFirst) / seconds(*period_);
  return sign * blur.length_px * per_second * along;
}

std::optional<double> MotionMemory::learned_kappa() const {
  if (ratios_.size() < kLeastRatios) return std::nullopt;
  std::vector<double> sorted(ratios_.begin(), ratios_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

void MotionMemory::learn_kappa() {
  const auto moving = velocity();
  if (!moving || !period_ || !last_->blur || last_->blur->length_px < kLeastBlurPx) return;
  const double periods = interval_in(*period_, before_->at, last_->at);
  if (periods < 0.5 || periods > kGap) return;
  ratios_.push_back(norm(*moving) * seconds(*period_) / last_->blur->length_px);
  if (ratios_.size() > kFramesKept) ratios_.pop_front();
}

Box MotionMemory::moved(Vec2 velocity) const {
  const Vec2 way = seconds(shown_.back() - last_->at) * velocity;
  Box box = last_->box;
  box.x += way.x, box.y += way.y;
  return box;
}

}  // namespace relock
