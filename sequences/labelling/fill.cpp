#include "sequences/labelling/fill.h"

#include <algorithm>
#include <cmath>

#include "sequences/labelling/outline_numbers.h"
#include "sequences/labelling/smooth_curve.h"

namespace relock {
namespace {

constexpr double kOccludedPart = 0.5;      // occluded says that more than half is hidden, not how much
constexpr std::size_t kEnoughLeftOut = 6;  // to hold a stated sigma against them
constexpr double kShareWithinSigma = 0.683;

/// Placed key frames that one curve goes through.
struct Stretch {
  std::vector<const KeyFrame*> keys;
  std::vector<OutlineNumbers> numbers;
  Readings x, y;
  std::vector<Readings> shape;
};

bool says_where(const KeyFrame& key) {
  return key.outline && (key.state == KeyState::placed || key.state == KeyState::occluded);
}

bool ends_a_stretch(const KeyFrame& key) {
  return key.state == KeyState::absent || key.state == KeyState::unlabelled;
}

void add(Readings& readings, double at_s, double value, double sigma) {
  readings.at_s.push_back(at_s);
  readings.value.push_back(value);
  readings.sigma.push_back(sigma);
}

class Filler {
 public:
  Filler(const KeyedTarget& target, std::span<const Time> captured, Size picture, const FillOptions& options)
      : target_(target), captured_(captured), picture_(picture), options_(options) {}

  FilledTarget fill() {
    result_.truth.resize(captured_.size());
    result_.rests_on.assign(captured_.size(), RestsOn::unknown);
    find_stretches();
    choose_models();
    for (const Stretch& stretch : stretches_) draw(stretch);
    hold_states();
    for (const KeyFrame& key : target_.keys) label_key(key);
    return std::move(result_);
  }

 private:
  double seconds_from(const Stretch& stretch, std::size_t frame) const {
    return seconds(captured_[frame] - captured_[stretch.keys.front()->frame]);
  }

  void find_stretches() {
    bool joined = false;
    for (const KeyFrame& key : target_.keys) {
      if (ends_a_stretch(key)) joined = false;
      if (!says_where(key)) continue;
      if (!joined || !continues(stretches_.back(), key)) stretches_.emplace_back();
      stretches_.back().keys.push_back(&key);
      joined = true;
    }
    for (Stretch& stretch : stretches_) read(stretch);
  }

  bool continues(const Stretch& stretch, const KeyFrame& key) const {
    const KeyFrame& last = *stretch.keys.back();
    return seconds(captured_[key.frame] - captured_[last.frame]) <= options_.max_gap_s &&
           key.outline->index() == last.outline->index();
  }

  void read(Stretch& stretch) const {
    for (const KeyFrame* key : stretch.keys) {
      OutlineNumbers numbers = numbers_of(*key->outline);
      if (!stretch.numbers.empty()) follow(numbers, stretch.numbers.back(), *key->outline);
      const double at = seconds_from(stretch, key->frame);
      add(stretch.x, at, numbers.middle.x, key->sigma_px);
      add(stretch.y, at, numbers.middle.y, key->sigma_px);
      stretch.shape.resize(numbers.shape.size());
      for (std::size_t i = 0; i < numbers.shape.size(); ++i)
        add(stretch.shape[i], at, numbers.shape[i], key->sigma_px * numbers.shape_per_px[i]);
      stretch.numbers.push_back(std::move(numbers));
    }
  }

  /// One for all places, in px, and one for all shapes, which have no unit: a target that darts about in one stretch
  /// does so in the next.
  void choose_models() {
    std::vector<Readings> places, shapes;
    double log_size = 0;
    std::size_t keys = 0;
    for (const Stretch& stretch : stretches_) {
      places.push_back(stretch.x);
      places.push_back(stretch.y);
      shapes.insert(shapes.end(), stretch.shape.begin(), stretch.shape.end());
      for (const KeyFrame* key : stretch.keys) log_size += std::log(size_of(*key->outline));
      keys += stretch.keys.size();
    }
    if (keys == 0) return;
    const double size = std::exp(log_size / static_cast<double>(keys));
    of_places_ = likely_model(places, options_.usual_restlessness * size * size, Models::all);
    of_shapes_ = likely_model(shapes, options_.usual_restlessness / 10, Models::steady);
    result_.widened = widening(places);
  }

  double widening(const std::vector<Readings>& places) const {
    std::vector<double> z;
    for (const Readings& each : places)
      for (const auto& left : leave_each_out(each, of_places_))
        if (left) z.push_back(std::abs(left->error) / left->sigma);
    if (z.size() < kEnoughLeftOut) return 1;
    const auto at =
        z.begin() + static_cast<std::ptrdiff_t>(kShareWithinSigma * static_cast<double>(z.size()));
    std::nth_element(z.begin(), at, z.end());
    return std::max(1.0, *at);
  }

  void draw(const Stretch& stretch) {
    if (stretch.keys.size() < 2) return;
    const SmoothCurve x(stretch.x, of_places_), y(stretch.y, of_places_);
    std::vector<SmoothCurve> shape;
    for (const Readings& each : stretch.shape) shape.emplace_back(each, of_shapes_);
    const LabelSource source = source_of(stretch);
    const std::vector<double> off = off_when_left_out(stretch);
    for (std::size_t i = 0; i + 1 < stretch.keys.size(); ++i)
      for (std::size_t frame = stretch.keys[i]->frame + 1; frame < stretch.keys[i + 1]->frame; ++frame) {
        const double at = seconds_from(stretch, frame);
        OutlineNumbers numbers{{x.value(at), y.value(at)}, {}, {}};
        for (const SmoothCurve& each : shape) numbers.shape.push_back(each.value(at));
        TargetTruth truth = label(outline_of(numbers, *stretch.keys[i]->outline), state_at(frame));
        truth.sigma_px = std::max({result_.widened, off[i], off[i + 1]}) *
                         std::hypot(x.sigma(at), y.sigma(at)) / std::sqrt(2.0);
        truth.source = source;
        result_.truth[frame] = std::move(truth);
        result_.rests_on[frame] = RestsOn::curve;
      }
  }

  /// Of each key frame, in sigmas. Cameras jerk now and then, and the model knows one restlessness for all times: where
  /// a key frame was a surprise, the curve beside it is less sure.
  std::vector<double> off_when_left_out(const Stretch& stretch) const {
    const auto x = leave_each_out(stretch.x, of_places_), y = leave_each_out(stretch.y, of_places_);
    std::vector<double> off(x.size(), 1.0);
    for (std::size_t i = 0; i < off.size(); ++i)
      if (x[i] && y[i])
        off[i] = std::hypot(x[i]->error / x[i]->sigma, y[i]->error / y[i]->sigma) / std::sqrt(2.0);
    return off;
  }

  static LabelSource source_of(const Stretch& stretch) {
    LabelSource source{LabelSource::Kind::spline};
    auto& names = source.detectors;
    for (const KeyFrame* key : stretch.keys)
      names.insert(names.end(), key->source.detectors.begin(), key->source.detectors.end());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return source;
  }

  /// Of the last key frame up to there.
  KeyState state_at(std::size_t frame) const {
    KeyState state = KeyState::placed;
    for (const KeyFrame& key : target_.keys)
      if (key.frame <= frame) state = key.state;
    return state;
  }

  TargetTruth label(const Outline& outline, KeyState state) const {
    TargetTruth truth = truth_of_outline(outline, picture_, options_.limits);
    if (state != KeyState::occluded || !truth.outline) return truth;
    truth.label = Label::unlabelled;
    truth.occluded_fraction = kOccludedPart;
    truth.visible_fraction = std::max(0.0, truth.visible_fraction - kOccludedPart);
    return truth;
  }

  void hold_states() {
    for (std::size_t i = 0; i < target_.keys.size(); ++i) {
      const KeyFrame& key = target_.keys[i];
      if (key.state == KeyState::placed) continue;
      const std::size_t end = i + 1 < target_.keys.size() ? target_.keys[i + 1].frame : captured_.size();
      for (std::size_t frame = key.frame; frame < end; ++frame) {
        if (result_.rests_on[frame] == RestsOn::curve) continue;
        result_.rests_on[frame] = RestsOn::held;
        if (key.state == KeyState::absent) result_.truth[frame] = absent(key.source);
      }
    }
  }

  static TargetTruth absent(const LabelSource& source) {
    TargetTruth truth;
    truth.label = Label::absent;
    truth.visible_fraction = 0;
    truth.source = source;
    return truth;
  }

  void label_key(const KeyFrame& key) {
    result_.rests_on[key.frame] = RestsOn::key;
    if (!says_where(key)) {
      result_.truth[key.frame] = key.state == KeyState::absent ? absent(key.source) : TargetTruth{};
      return;
    }
    TargetTruth truth = label(*key.outline, key.state);
    truth.sigma_px = key.sigma_px;
    truth.source = key.source;
    result_.truth[key.frame] = std::move(truth);
  }

  const KeyedTarget& target_;
  std::span<const Time> captured_;
  Size picture_;
  const FillOptions& options_;
  std::vector<Stretch> stretches_;
  CurveModel of_places_, of_shapes_;
  FilledTarget result_;
};

}  // namespace

FilledTarget fill(const KeyedTarget& target, std::span<const Time> captured, Size picture,
                  const FillOptions& options) {
  return Filler(target, captured, picture, options).fill();
}

std::vector<KeyResidual> cross_validate(const KeyedTarget& target, std::span<const Time> captured,
                                        Size picture, const FillOptions& options) {
  std::vector<KeyResidual> residuals;
  for (const KeyFrame& key : target.keys) {
    if (key.state != KeyState::placed) continue;
    KeyedTarget others = target;
    take_key(others, key.frame);
    const FilledTarget filled = fill(others, captured, picture, options);
    const TargetTruth& truth = filled.truth[key.frame];
    if (filled.rests_on[key.frame] != RestsOn::curve || !truth.outline) continue;
    residuals.push_back({key.frame, centre_of(*key.outline) - centre_of(*truth.outline),
                         std::hypot(truth.sigma_px, key.sigma_px), size_of(*key.outline)});
  }
  return residuals;
}

}  // namespace relock
