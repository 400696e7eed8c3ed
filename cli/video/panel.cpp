#include "cli/video/panel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cli/timeline_figure.h"
#include "cli/video/ink.h"

namespace relock {
namespace {

using namespace ink;

constexpr double kLane = 9;  // px, of one target

std::string_view colour_of(const std::optional<LaneLook>& look) {
  return look ? std::string_view(look->colour) : kLight;
}

/// Adds an outline in the recording's pixels to the path.
void trace(cairo_t* on, const Outline& outline) {
  if (const auto* e = std::get_if<Ellipse>(&outline)) {
    cairo_save(on);
    cairo_translate(on, e->centre.x, e->centre.y);
    cairo_rotate(on, e->angle_rad);
    cairo_scale(on, e->semi_major, e->semi_minor);
    cairo_new_sub_path(on);
    cairo_arc(on, 0, 0, 1, 0, 2 * std::numbers::pi);
    cairo_close_path(on);
    cairo_restore(on);
    return;
  }
  std::array<Vec2, 4> corners;
  if (const auto* quad = std::get_if<Quad>(&outline)) {
    corners = quad->corner;
  } else {
    const Box& b = std::get<Box>(outline);
    corners = {{{b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}}};
  }
  cairo_move_to(on, corners[0].x, corners[0].y);
  for (std::size_t i = 1; i < 4; ++i) cairo_line_to(on, corners[i].x, corners[i].y);
  cairo_close_path(on);
}

/// Strokes the path in sheet pixels, with a rim that is seen on any ground, and forgets it.
void stroke(cairo_t* on, double width_px, std::string_view colour, std::string_view rim) {
  cairo_save(on);
  cairo_identity_matrix(on);
  cairo_set_line_width(on, width_px + 2);
  set_colour(on, rim, .7);
  cairo_stroke_preserve(on);
  cairo_set_line_width(on, width_px);
  set_colour(on, colour);
  cairo_stroke(on);
  cairo_restore(on);
}

void trace_cross(cairo_t* on, Vec2 centre, double reach) {
  cairo_move_to(on, centre.x - reach, centre.y);
  cairo_line_to(on, centre.x + reach, centre.y);
  cairo_move_to(on, centre.x, centre.y - reach);
  cairo_line_to(on, centre.x, centre.y + reach);
}

/// How bad it is, so that one of several targets speaks for all.
int badness(Verdict verdict) {
  constexpr std::array<int, kVerdicts> kBadness{0, 0, 1, 2, 0, 3, 7, 8, 6, 5, 2};
  return kBadness[static_cast<std::size_t>(verdict)];
}

std::string spoken(Verdict verdict) {
  switch (verdict) {
    case Verdict::NotStarted:
      return "not started";
    case Verdict::Given:
      return "Given: it starts here";
    case Verdict::Skipped:
      return "Skipped: it was busy";
    case Verdict::CorrectReject:
      return "CorrectReject: no target";
    default:
      return std::string(to_string(verdict));
  }
}

}  // namespace

Panel::Panel(const ScoredComparison& compared, std::size_t run, std::vector<std::size_t> targets,
             double scale)
    : compared_(compared),
      run_(run),
      targets_(std::move(targets)),
      scale_(scale),
      picture_width_(std::round(scale * recording().picture.width)),
      picture_height_(std::round(scale * recording().picture.height)),
      letters_(std::clamp(picture_width_ / 40, 12., 20.)) {}

Size Panel::size() const {
  const double lanes = kLane * static_cast<double>(targets_.size()) + 4;
  return {static_cast<int>(picture_width_),
          static_cast<int>(std::lround(1.8 * letters_ + picture_height_ + lanes))};
}

// What is said above

double Panel::lost_for_s(std::size_t target, std::size_t frame) const {
  const auto& losses = timeline(target).losses;
  const auto& captured = recording().captured;
  for (auto loss = losses.rbegin(); loss != losses.rend(); ++loss)
    if (loss->last_good <= static_cast<FrameIndex>(frame))
      return seconds(captured[frame] - captured[static_cast<std::size_t>(loss->last_good)]);
  return 0;
}

std::string Panel::status_of(std::size_t target, std::size_t frame) const {
  const Judgement& judgement = timeline(target).judgements[frame];
  std::string text = spoken(judgement.verdict);
  if (judgement.failed) return "failed";
  if (judgement.verdict != Verdict::Miss && std::isfinite(judgement.error_px))
    text += fmt::format(", {:.1f} px", judgement.error_px);
  if (timeline(target).states[frame] == State::Lost)
    text += fmt::format(", lost for {:.2f} s", lost_for_s(target, frame));
  return text;
}

std::string Panel::status(const Shot& shot) const {
  if (!shot.frame) return "no frame yet";
  const std::size_t frame = *shot.frame;
  if (targets_.size() == 1) return status_of(targets_.front(), frame);
  std::array<int, kVerdicts> counts{};
  int lost = 0;
  for (const std::size_t target : targets_) {
    ++counts[static_cast<std::size_t>(timeline(target).judgements[frame].verdict)];
    lost += timeline(target).states[frame] == State::Lost ? 1 : 0;
  }
  std::vector<std::string> parts;
  for (std::size_t v = 0; v < kVerdicts; ++v)
    if (counts[v] > 0) parts.push_back(fmt::format("{} {}", counts[v], to_string(static_cast<Verdict>(v))));
  if (lost > 0) parts.push_back(fmt::format("{} lost", lost));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Verdict Panel::worst(std::size_t frame) const {
  Verdict worst = Verdict::NotStarted;
  for (const std::size_t target : targets_) {
    const Verdict verdict = timeline(target).judgements[frame].verdict;
    if (badness(verdict) > badness(worst)) worst = verdict;
  }
  return worst;
}

void Panel::draw_heading(cairo_t* on, Vec2 corner, const Shot& shot) const {
  const Letters plain{letters_}, bold{letters_, true};
  const double base = corner.y + 1.3 * letters_, gap = .5 * letters_, side = .8 * letters_;
  const std::string said = fitted(on, status(shot), .6 * picture_width_, plain);
  const double said_from = corner.x + picture_width_ - width_of(on, said, plain) - gap;
  write(on, said, {said_from, base}, plain, kBlack);
  if (shot.frame)
    fill_box(on, {said_from - side - .4 * letters_, base - side + .05 * letters_, side, side},
             colour_of(look_of(worst(*shot.frame))));
  const double room = said_from - corner.x - side - 2.5 * gap;
  write(on, fitted(on, run().record.method, room, bold), {corner.x + gap, base}, bold, kBlack);
}

// On the picture

void Panel::draw_truth(cairo_t* on, std::size_t frame) const {
  constexpr double kDashes[] = {5, 4};
  for (const std::size_t target : targets_) {
    const TargetTruth& truth = recording().truth_of(frame, target);
    if (!truth.outline || truth.label == Label::absent) continue;
    trace(on, *truth.outline);
    cairo_save(on);
    cairo_identity_matrix(on);
    cairo_set_line_width(on, 3);
    set_colour(on, "#000000", .6);
    cairo_stroke_preserve(on);
    cairo_set_dash(on, kDashes, 2, 0);
    cairo_set_line_width(on, 1.6);
    set_colour(on, kWhite);
    cairo_stroke(on);
    cairo_restore(on);
  }
}

bool Panel::is_shown(const TargetId& id) const {
  return std::any_of(targets_.begin(), targets_.end(),
                     [&](std::size_t target) { return recording().targets[target].id == id; });
}

void Panel::draw_answers(cairo_t* on, std::size_t frame) const {
  const FrameReport& report = run().trajectory.frames[frame];
  for (std::size_t i = 0; i < report.sightings.size(); ++i) {
    const Sighting& sighting = report.sightings[i];
    if (sighting.track && !is_shown(*sighting.track)) continue;
    std::string_view colour = kGrey;  // of nobody that is judged here
    for (const std::size_t target : targets_) {
      const Judgement& judgement = timeline(target).judgements[frame];
      if (judgement.sighting == static_cast<int>(i)) colour = colour_of(look_of(judgement.verdict));
    }
    trace(on, sighting.outline);
    stroke(on, 2.4, colour, kWhite);
    trace_cross(on, sighting.centre, 5 / scale_);
    stroke(on, 1.6, colour, kWhite);
  }
  for (const std::size_t target : report.given) {
    const auto& outline = recording().truth_of(frame, target).outline;
    if (!outline || !is_shown(recording().targets[target].id)) continue;
    trace(on, bounds(*outline));
    stroke(on, 2.4, "#000000", kWhite);
  }
}

void Panel::draw_standstill(cairo_t* on, Vec2 corner, const Shot& shot) const {
  fill_box(on, {corner.x, corner.y, picture_width_, picture_height_}, kWhite, .45);
  const Time since = recording().captured[shot.frame.value_or(0)];
  const std::string text = shot.frame ? fmt::format("no frame for {:.2f} s", seconds(shot.shown - since))
                                      : std::string("no frame yet");
  const Letters bold{1.2 * letters_, true};
  const double width = width_of(on, text, bold), left = corner.x + (picture_width_ - width) / 2,
               base = corner.y + picture_height_ - 1.6 * letters_;
  fill_box(on, {left - letters_, base - 1.7 * letters_, width + 2 * letters_, 2.4 * letters_}, kBlack, .85);
  write(on, text, {left, base}, bold, kWhite);
}

// Below

void Panel::draw_lanes(cairo_t* on, Vec2 corner, Time now) const {
  const auto& captured = recording().captured;
  const double length = seconds(captured.back() - captured.front() + recording().period);
  // On whole pixels: between frames that follow each other no seam is seen.
  const auto x = [&](Time at) {
    return std::round(corner.x + picture_width_ * seconds(at - captured.front()) / length);
  };
  for (std::size_t row = 0; row < targets_.size(); ++row) {
    const double middle = corner.y + 2 + kLane * (static_cast<double>(row) + .5);
    for (std::size_t frame = 0; frame < captured.size(); ++frame) {
      const auto look = look_of(timeline(targets_[row]).judgements[frame].verdict);
      if (!look) continue;
      Time to = captured[frame] + recording().period;
      if (frame + 1 < captured.size()) {
        const Duration interval = captured[frame + 1] - captured[frame];
        if (slots(interval, recording().period) < 2) to = captured[frame + 1];
      }
      fill_box(on,
               {x(captured[frame]), middle - look->high * kLane, std::max(x(to) - x(captured[frame]), 1.),
                (look->high - look->low) * kLane},
               look->colour);
    }
  }
  const double rows = kLane * static_cast<double>(targets_.size()) + 3;
  fill_box(on, {x(now) - 2, corner.y, 4, rows}, kWhite);
  fill_box(on, {x(now) - 1, corner.y, 2, rows}, kBlack);
}

void Panel::draw(cairo_t* on, Vec2 corner, const cv::Mat& picture, const Shot& shot) const {
  draw_heading(on, corner, shot);
  const Vec2 inside = corner + Vec2{0, std::round(1.8 * letters_)};
  const Box box{inside.x, inside.y, picture_width_, picture_height_};
  cairo_save(on);
  cairo_rectangle(on, box.x, box.y, box.width, box.height);
  cairo_clip(on);
  if (picture.empty())
    fill_box(on, box, kLight);
  else
    paint(on, picture, box);
  if (shot.frame) {
    cairo_save(on);
    cairo_translate(on, inside.x + scale_ / 2, inside.y + scale_ / 2);  // pixel centres are at integers
    cairo_scale(on, scale_, scale_);
    draw_truth(on, *shot.frame);
    draw_answers(on, *shot.frame);
    cairo_restore(on);
  }
  if (shot.frozen) draw_standstill(on, inside, shot);
  cairo_restore(on);
  draw_lanes(on, inside + Vec2{0, picture_height_}, shot.shown);
}

}  // namespace relock
