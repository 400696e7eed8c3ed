#include "core/motion_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relock {
namespace {

constexpr std::size_t kFramesKept = 64;
constexpr std::size_t kLeastToLearn = 5;
constexpr double kLeastBlurPx = 2;  // shorter ones are measured too coarsely to learn from
constexpr double kKappaAtFirst = 2;
constexpr double kLeastAgreement = 0.25;  // of the blur's speed, in the answers: else they know no way
constexpr double kSamePx = 1e-3;          // errors that differ by less are equal: rounding

double interval_in(Duration period, Time from, Time to) { return seconds(to - from) / seconds(period); }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

MotionMemory::MotionMemory(std::optional<double> period_s, std::optional<double> exposure_s)
    : period_is_known_(period_s.has_value()), exposure_s_(exposure_s) {
  if (period_s) period_ = Duration(std::llround(*period_s * 1e9));
}

void MotionMemory::show(Time captured) {
  if (!period_is_known_ && shown_.size() >= 2)
    period_ = nominal_period(std::vector<Time>(shown_.begin(), shown_.end()));
  shown_.push_back(captured);
  if (shown_.size() > kFramesKept) shown_.pop_front();
}

void MotionMemory::see(const Box& box, const std::optional<BlurEstimate>& blur) {
  if (shown_.empty()) return;
  compare_speedometers(box);
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

std::vector<Vec2> MotionMemory::velocities_by_blur() const {
  if (!period_ || !last_ || !last_->blur) return {};
  const BlurEstimate& blur = *last_->blur;
  const double per_second =
      exposure_s_ ? 1 / *exposure_s_ : learned_kappa().value_or(kKappaAtFirst) / seconds(*period_);
  const Vec2 along =
      blur.length_px * per_second * Vec2{std::cos(blur.direction_rad), std::sin(blur.direction_rad)};
  const auto way = velocity();
  const double forward = way ? dot(along, *way) : 0;
  if (std::abs(forward) < kLeastAgreement * dot(along, along)) return {along, -1 * along};
  return {forward < 0 ? -1 * along : along};
}

std::optional<bool> MotionMemory::blur_tells_better() const {
  if (errors_.size() < kLeastToLearn) return std::nullopt;
  std::vector<double> by_answers, by_blur;
  for (const StepErrors& step : errors_)
    by_answers.push_back(step.by_answers_px), by_blur.push_back(step.by_blur_px);
  return median(std::move(by_blur)) <= median(std::move(by_answers)) + kSamePx;
}

std::optional<double> MotionMemory::learned_kappa() const {
  if (ratios_.size() < kLeastToLearn) return std::nullopt;
  return median({ratios_.begin(), ratios_.end()});
}

void MotionMemory::learn_kappa() {
  const auto moving = velocity();
  if (!moving || !period_ || !last_->blur || last_->blur->length_px < kLeastBlurPx) return;
  const double periods = interval_in(*period_, before_->at, last_->at);
  if (periods < 0.5 || periods > kGap) return;
  ratios_.push_back(norm(*moving) * seconds(*period_) / last_->blur->length_px);
  if (ratios_.size() > kFramesKept) ratios_.pop_front();
}

void MotionMemory::compare_speedometers(const Box& box) {
  const auto by_answers = velocity();
  const auto by_blur = velocities_by_blur();
  if (!by_answers || by_blur.size() != 1 || after_gap() || missing_periods() > kGap - 1) return;
  const auto error = [&](Vec2 velocity) { return norm(centre_of(moved(velocity)) - centre_of(box)); };
  errors_.push_back({error(*by_answers), error(by_blur.front())});
  if (errors_.size() > kFramesKept) errors_.pop_front();
}

Box MotionMemory::moved(Vec2 velocity) const {
  const Vec2 way = seconds(shown_.back() - last_->at) * velocity;
  Box box = last_->box;
  box.x += way.x, box.y += way.y;
  return box;
}

}  // namespace relock
