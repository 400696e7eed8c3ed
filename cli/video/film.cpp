#include "cli/video/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "cli/timeline_figure.h"
#include "cli/video/ink.h"
#include "core/opencv.h"
#include "sequences/simulator/preview.h"

namespace relock {
namespace {

using namespace ink;

constexpr double kWidest = 1920, kLeastPanel = 480;  // px
constexpr int kBetween = 8;                          // px, from panel to panel
constexpr double kFootLetters = 13;                  // px
constexpr int kFoot = 46;                            // px: two rows

std::size_t columns_for(std::size_t panels) {
  if (panels <= 3) return std::max<std::size_t>(panels, 1);
  return static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(panels))));
}

/// Small pictures are drawn larger, so that letters are read; a sheet is no wider than a screen.
double scale_for(Size picture, std::size_t columns) {
  const double widest =
      (kWidest - kBetween * static_cast<double>(columns + 1)) / static_cast<double>(columns);
  return std::min(widest / picture.width, std::max(1., kLeastPanel / picture.width));
}

std::vector<bool> came(const ScoredComparison& compared, std::size_t run) {
  std::vector<bool> all;
  for (const FrameReport& frame : compared.stored.runs[run].trajectory.frames)
    all.push_back(frame.delivery != Delivery::dropped);
  return all;
}

}  // namespace

Film::Film(const ScoredComparison& compared, const FilmPlan& plan)
    : compared_(compared), columns_(columns_for(plan.runs.size())) {
  const Recording& recording = compared.stored.recording;
  const double scale = scale_for(recording.picture, columns_);
  for (const std::size_t run : plan.runs) panels_.emplace_back(compared, run, plan.targets, scale);
  shots_ = shots_of(recording, came(compared, plan.runs.front()), plan.from, plan.to);
}

Size Film::size() const {
  const Size panel = panels_.front().size();
  const int columns = static_cast<int>(columns_),
            rows = (static_cast<int>(panels_.size()) + columns - 1) / columns;
  return {columns * (panel.width + kBetween) + kBetween, rows * (panel.height + kBetween) + kFoot};
}

void Film::draw_foot(cairo_t* on, const Shot& shot) const {
  const Recording& recording = compared_.stored.recording;
  const Letters letters{kFootLetters};
  const double left = kBetween, right = size().width - kBetween, above = size().height - kFoot + 16.;
  const std::string now =
      fmt::format("frame {} of {}   {:.3f} s", shot.frame ? std::to_string(*shot.frame) : "-",
                  recording.frames(), seconds(shot.shown - recording.captured.front()));
  const double now_from = right - width_of(on, now, letters);
  write(on, now, {now_from, above}, letters, kBlack);
  write(on, fitted(on, heading(compared_.stored, compared_.gate), now_from - left - 20, letters),
        {left, above}, letters, kBlack);
  double x = left;
  const double base = above + 20;
  const auto name = [&](std::string_view text) {
    write(on, text, {x, base}, letters, kGrey);
    x += width_of(on, text, letters) + 16;
  };
  name("dashed: truth");
  for (const Verdict verdict : {Verdict::Given, Verdict::Hit, Verdict::Stray, Verdict::Miss, Verdict::WrongId,
                                Verdict::FalseAlarm, Verdict::CorrectReject}) {
    const auto look = look_of(verdict);
    fill_box(on, {x, base - 5 - look->high * 12, 10, (look->high - look->low) * 12}, look->colour);
    x += 14;
    name(to_string(verdict));
  }
}

cv::Mat Film::sheet(const cv::Mat& picture, const Shot& shot) const {
  const Sheet sheet(size());
  const Size panel = panels_.front().size();
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const Vec2 corner{
        static_cast<double>(kBetween + static_cast<int>(i % columns_) * (panel.width + kBetween)),
        static_cast<double>(static_cast<int>(i / columns_) * (panel.height + kBetween))};
    panels_[i].draw(sheet.on(), corner, picture, shot);
  }
  draw_foot(sheet.on(), shot);
  return sheet.picture();
}

bool write_film(const Film& film, FrameSource& frames, Duration period, const std::filesystem::path& file) {
  const InterruptNote interrupt;
  Progress progress("video", static_cast<std::int64_t>(film.shots().size()));
  simulator::PreviewWriter writer(file, film.size(), 1 / seconds(period));
  cv::Mat picture;
  std::optional<std::size_t> decoded;
  std::int64_t done = 0;
  for (const Shot& shot : film.shots()) {
    if (interrupt.asked()) return false;
    if (shot.frame && shot.frame != decoded) {
      std::optional<FrameStamp> stamp;
      do {
        stamp = frames.next();
      } while (stamp && stamp->index < static_cast<FrameIndex>(*shot.frame));
      bgr_copy(frames.image(), picture);
      decoded = shot.frame;
    }
    writer.add(film.sheet(picture, shot), shot.shown);
    progress.done(++done);
  }
  writer.finish();
  return true;
}

}  // namespace relock
