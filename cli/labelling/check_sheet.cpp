#include "cli/labelling/check_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "cli/labelling/shelf.h"
#include "cli/table.h"
#include "core/opencv.h"

namespace relock {
namespace {

constexpr int kTile_px = 200, kColumns = 6, kCaption_px = 34;
constexpr std::size_t kMostTiles = 36;  // of one target
constexpr double kAround = 2.5;         // a tile shows so many of the label's longer side
constexpr std::size_t kTooFew = 8;      // residuals, to judge a stated sigma by
const cv::Scalar kOrange(0, 159, 230), kBlue(233, 180, 86), kInk(20, 20, 20), kPaper(244, 244, 244);

std::vector<double> in_sigmas(const LabelCheck& check) {
  std::vector<double> all;
  for (const KeyResidual& each : check.left_out) {
    all.push_back(std::abs(each.error_px.x) / each.sigma_px);
    all.push_back(std::abs(each.error_px.y) / each.sigma_px);
  }
  return all;
}

double part_of_size(const TargetTruth& truth) { return truth.sigma_px / size_of(*truth.outline); }

/// Frames to show of a target, in order: key frames with an outline and the least sure ones between.
std::vector<std::size_t> frames_to_show(const FilledTarget& filled) {
  std::vector<std::size_t> keys, curve;
  for (std::size_t frame = 0; frame < filled.truth.size(); ++frame) {
    if (!filled.truth[frame].outline) continue;
    (filled.rests_on[frame] == RestsOn::key ? keys : curve).push_back(frame);
  }
  std::stable_sort(curve.begin(), curve.end(), [&](std::size_t a, std::size_t b) {
    return part_of_size(filled.truth[a]) > part_of_size(filled.truth[b]);
  });
  std::set<std::size_t> shown;
  const std::size_t half = kMostTiles / 2;
  for (std::size_t i = 0; i < std::min(keys.size(), half); ++i)  // spread over all of them
    shown.insert(keys[i * keys.size() / std::min(keys.size(), half)]);
  for (std::size_t i = 0; i < curve.size() && shown.size() < kMostTiles; ++i) shown.insert(curve[i]);
  return {shown.begin(), shown.end()};
}

/// The outline's corners, or points all round it, on a tile.
std::vector<cv::Point> path_on_tile(const Outline& outline, Vec2 corner, double scale) {
  std::vector<Vec2> path;
  if (const auto* box = std::get_if<Box>(&outline)) {
    path = {{box->x, box->y}, {box->right(), box->y}, {box->right(), box->bottom()}, {box->x, box->bottom()}};
  } else if (const auto* quad = std::get_if<Quad>(&outline)) {
    path.assign(quad->corner.begin(), quad->corner.end());
  } else {
    const auto& e = std::get<Ellipse>(outline);
    for (int i = 0; i < 60; ++i) {
      const double at = i * CV_PI / 30, u = e.semi_major * std::cos(at), v = e.semi_minor * std::sin(at);
      path.push_back(e.centre + Vec2{u * std::cos(e.angle_rad) - v * std::sin(e.angle_rad),
                                     u * std::sin(e.angle_rad) + v * std::cos(e.angle_rad)});
    }
  }
  std::vector<cv::Point> points;
  for (const Vec2 each : path) {
    const Vec2 at = scale * (each - corner);
    points.emplace_back(static_cast<int>(std::lround(16 * at.x)), static_cast<int>(std::lround(16 * at.y)));
  }
  return points;
}

cv::Mat tile(const cv::Mat& picture, const TargetTruth& truth, const cv::Scalar& colour,
             const std::vector<std::string>& caption) {
  const Box box = bounds(*truth.outline);
  const double side = std::max(kAround * std::max(box.width, box.height), 16.0), scale = kTile_px / side;
  const Vec2 centre = centre_of(box), corner{centre.x - side / 2, centre.y - side / 2};
  cv::Mat result(kTile_px + kCaption_px, kTile_px, CV_8UC3, kPaper), colours;
  bgr_copy(view(picture), colours);
  // Where the picture's places come to lie: pixel centres at whole numbers in both.
  const cv::Matx23d place(scale, 0, -scale * corner.x - 0.5, 0, scale, -scale * corner.y - 0.5);
  cv::warpAffine(colours, result.rowRange(0, kTile_px), place, {kTile_px, kTile_px},
                 scale > 2 ? cv::INTER_NEAREST : cv::INTER_LINEAR, cv::BORDER_CONSTANT, kInk);
  cv::Mat shown = result.rowRange(0, kTile_px);
  cv::polylines(shown, path_on_tile(*truth.outline, corner, scale), true, colour, 1, cv::LINE_AA, 4);
  for (std::size_t i = 0; i < caption.size(); ++i)
    cv::putText(result, caption[i], {4, kTile_px + 13 + 15 * static_cast<int>(i)}, cv::FONT_HERSHEY_SIMPLEX,
                0.4, kInk, 1, cv::LINE_AA);
  return result;
}

const KeyResidual* residual_of(const LabelCheck& check, std::size_t frame) {
  for (const KeyResidual& each : check.left_out)
    if (each.frame == frame) return &each;
  return nullptr;
}

/// Two short lines; `whose` is empty where there is one target.
std::vector<std::string> caption(const LabelCheck& check, const std::string& whose,
                                 const FilledTarget& filled, std::size_t frame) {
  const bool key = filled.rests_on[frame] == RestsOn::key;
  const std::string source = key ? to_string(filled.truth[frame].source) : "curve";
  const std::string first = fmt::format("{}{} {}", whose, frame, source);
  const KeyResidual* left = key ? residual_of(check, frame) : nullptr;
  const std::string off =
      left != nullptr ? fmt::format(", left out {:+.1f} {:+.1f}", left->error_px.x, left->error_px.y) : "";
  return {first, fmt::format("+-{:.1f} px{}", filled.truth[frame].sigma_px, off)};
}

std::string judgement(const LabelCheck& check) {
  const auto two = share_within(check, 2);
  if (2 * check.left_out.size() < kTooFew)
    return "too few key frames to tell whether the stated sigma is true";
  if (*two < 0.85) return "the stated sigma is too small: place more key frames where N leads";
  return "the stated sigma holds";
}

}  // namespace

std::vector<LabelCheck> check_labels(const LabelDesk& desk) {
  std::vector<LabelCheck> checks;
  const Recording& recording = desk.sequence().recording;
  for (std::size_t t = 0; t < desk.document().targets.size(); ++t) {
    const KeyedTarget& target = desk.document().targets[t];
    LabelCheck check{target.id,
                     cross_validate(target, recording.captured, recording.picture, desk.options())};
    for (const TargetTruth& truth : desk.filled()[t].truth) {
      if (truth.label == Label::unlabelled) continue;
      check.by_hand += truth.source.kind == LabelSource::Kind::hand ? 1 : 0;
      check.by_curve += truth.source.kind == LabelSource::Kind::spline ? 1 : 0;
      check.by_detector += truth.source.kind == LabelSource::Kind::detector ? 1 : 0;
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

std::optional<double> share_within(const LabelCheck& check, double sigmas) {
  const auto all = in_sigmas(check);
  if (all.empty()) return {};
  const auto within = std::count_if(all.begin(), all.end(), [&](double z) { return z <= sigmas; });
  return static_cast<double>(within) / static_cast<double>(all.size());
}

std::optional<double> rms_px(const LabelCheck& check) {
  if (check.left_out.empty()) return {};
  double sum = 0;
  for (const KeyResidual& each : check.left_out) sum += dot(each.error_px, each.error_px) / 2;
  return std::sqrt(sum / static_cast<double>(check.left_out.size()));
}

std::string check_text(const LabelDesk& desk, const std::vector<LabelCheck>& checks) {
  const Recording& recording = desk.sequence().recording;
  std::string text =
      fmt::format("{}: {} frames; key frames left out one by one, against the curve through the others\n",
                  recording.name, recording.frames());
  Table table(
      {"target", "hand", "curve", "detector", "left out", "rms px", "within 1 sigma %", "within 2 sigma %"});
  const auto percent = [](const std::optional<double>& share) {
    return cell(share ? std::optional(100 * *share) : std::nullopt, 0);
  };
  for (const LabelCheck& check : checks)
    table.add({check.target, std::to_string(check.by_hand), std::to_string(check.by_curve),
               std::to_string(check.by_detector), std::to_string(check.left_out.size()),
               cell(rms_px(check), 1), percent(share_within(check, 1)), percent(share_within(check, 2))});
  text += table.text(2);
  text += "An honest sigma has 68 % within one and 95 % within two.\n";
  for (const LabelCheck& check : checks) text += fmt::format("{}: {}\n", check.target, judgement(check));
  return text;
}

cv::Mat contact_sheet(const LabelDesk& desk, const std::vector<LabelCheck>& checks) {
  PictureShelf shelf(desk.sequence().frames);
  std::vector<cv::Mat> tiles;
  for (std::size_t t = 0; t < checks.size(); ++t) {
    const FilledTarget& filled = desk.filled()[t];
    const std::string whose = checks.size() > 1 ? checks[t].target + " " : "";
    for (const std::size_t frame : frames_to_show(filled))
      tiles.push_back(tile(shelf.picture(frame), filled.truth[frame],
                           filled.rests_on[frame] == RestsOn::key ? kOrange : kBlue,
                           caption(checks[t], whose, filled, frame)));
  }
  const int count = static_cast<int>(tiles.size()), rows = std::max(1, (count + kColumns - 1) / kColumns);
  const int high = kTile_px + kCaption_px, wide = kTile_px + 6;
  cv::Mat sheet(rows * high + 6, kColumns * wide + 6, CV_8UC3, kPaper);
  for (int i = 0; i < count; ++i)
    tiles[static_cast<std::size_t>(i)].copyTo(
        sheet(cv::Rect(6 + wide * (i % kColumns), 6 + high * (i / kColumns), kTile_px, high)));
  return sheet;
}

}  // namespace relock
