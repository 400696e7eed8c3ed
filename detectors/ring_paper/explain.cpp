#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/opencv.h"
#include "detectors/ring_paper/detector.h"

// The stages of the detector as pictures and charts, of what look() has left behind.

namespace relock::ring_paper {
namespace {

constexpr int kFractionBits = 4;  // OpenCV draws to parts of a pixel
const cv::Scalar kGreen(0, 200, 0), kRed(0, 0, 230), kOrange(0, 140, 255);

cv::Point drawn_at(Vec2 point) {
  return {cvRound(point.x * (1 << kFractionBits)), cvRound(point.y * (1 << kFractionBits))};
}
void draw_line(cv::Mat3b& picture, Vec2 from, Vec2 to, const cv::Scalar& colour, int width) {
  cv::line(picture, drawn_at(from), drawn_at(to), colour, width, cv::LINE_AA, kFractionBits);
}

cv::Mat3b colours_of(const cv::Mat1b& gray) {
  cv::Mat3b colours;
  cv::cvtColor(gray, colours, cv::COLOR_GRAY2BGR);
  return colours;
}
/// Half as bright, for what is drawn on it to be seen.
cv::Mat3b dimmed(const cv::Mat1b& gray) {
  cv::Mat1b half;
  gray.convertTo(half, CV_8U, 0.5);
  return colours_of(half);
}

/// Neighbouring numbers get colours that are far apart: each is 137 degrees of hue on.
cv::Vec3b colour_of(std::size_t number) {
  cv::Mat3b one(1, 1, cv::Vec3b(static_cast<std::uint8_t>(number * 69 % 180), 200, 255));
  cv::cvtColor(one, one, cv::COLOR_HSV2BGR);
  return one(0, 0);
}

/// The pixels of each component in the colour of its number; `number_of` a component's rank.
template <class NumberOf>
cv::Mat3b coloured(const Look& look, cv::Mat3b picture, NumberOf number_of) {
  for (std::size_t i = 0; i < look.components.parts.size(); ++i) {
    const Component& part = look.components.parts[i];
    picture(part.box).setTo(cv::Scalar(colour_of(number_of(i))),
                            look.components.labels(part.box) == part.label);
  }
  return picture;
}

Stage filter_stage(const Look& look, double threshold) {
  cv::Mat1b response;
  look.response.convertTo(response, CV_8U, 255);
  double most = 0;
  cv::minMaxLoc(look.response, nullptr, &most);
  return {"filter",
          fmt::format(
              "norm of the Gabor filters' outputs, normalised; black 0, white 1, at most {:.2f} here; the "
              "threshold is {}",
              most, threshold),
          response};
}

Stage components_stage(const Look& look, int least_area) {
  return {"components",
          fmt::format(
              "{} connected components above the threshold, in a colour each; grey are those of less than "
              "{} pixels",
              look.components.parts.size(), least_area),
          coloured(look, dimmed(look.binary), [](std::size_t i) { return i; })};
}

Stage clusters_stage(const Look& look, double linkage_px) {
  std::vector<std::size_t> cluster_of(look.components.parts.size());
  for (std::size_t c = 0; c < look.candidates.size(); ++c)
    for (const std::size_t i : look.candidates[c].cluster) cluster_of[i] = c;
  cv::Mat3b picture = coloured(look, dimmed(look.gray), [&](std::size_t i) { return cluster_of[i]; });
  for (std::size_t c = 0; c < look.candidates.size(); ++c)
    cv::rectangle(picture, rounded_rect(look.candidates[c].axis.box), cv::Scalar(colour_of(c)));
  return {"clusters",
          fmt::format("{} clusters of components, on average up to {} px apart, in a colour each",
                      look.candidates.size(), linkage_px),
          picture};
}

Stage direction_stage(const Look& look, double margin_px) {
  cv::Mat3b picture = colours_of(look.gray);
  for (const Candidate& c : look.candidates) {
    const auto [from, to] = through_box(c.axis, margin_px);
    const Vec2 across = c.axis.width * Vec2{-c.axis.direction.y, c.axis.direction.x};
    cv::rectangle(picture, rounded_rect(c.axis.box), kOrange);
    draw_line(picture, from, to, kRed, 2);
    draw_line(picture, c.axis.mean - across, c.axis.mean + across, kOrange, 1);
  }
  return {"direction",
          "the first principal component of each cluster through its box (red), and one standard deviation "
          "across it",
          picture};
}

/// 1 within a bar and 0 without, as steps from the profile's darkest level to its brightest.
ChartCurve steps_of(const std::vector<Bar>& bars, const std::vector<float>& levels, std::string name) {
  const auto [darkest, brightest] = std::minmax_element(levels.begin(), levels.end());
  const double low = *darkest, high = *brightest;
  ChartCurve curve{std::move(name), {{0, low}}};
  for (const Bar& bar : bars)
    curve.points.insert(curve.points.end(),
                        {{bar.from, low}, {bar.from, high}, {bar.to, high}, {bar.to, low}});
  curve.points.push_back({static_cast<double>(levels.size()) - 1, low});
  return curve;
}

ChartCurve curve_of(const std::vector<float>& levels, double step, std::string name) {
  ChartCurve curve{std::move(name), {}};
  for (std::size_t i = 0; i < levels.size(); ++i)
    curve.points.push_back({step * static_cast<double>(i), levels[i]});
  return curve;
}

Stage profile_stage(const Candidate& c) {
  Chart chart{"along the first principal component (px)", "grey level", {}};
  chart.curves.push_back(curve_of(c.profile.levels, 1, "profile"));
  chart.curves.push_back(steps_of(c.bars, c.profile.levels, "bright stretches"));
  if (c.marks) chart.curves.push_back(steps_of(c.marks->bars, c.profile.levels, "taken for the marker's"));
  return {"profile",
          c.marks ? fmt::format("{} bright stretches, of which {} are taken for a marker of {:.1f} px",
                                c.bars.size(), c.marks->bars.size(), 2 * c.marks->radius())
                  : fmt::format("{} bright stretches, whose number or widths no marker has", c.bars.size()),
          chart};
}

Stage classification_stage(const Candidate& c, const std::vector<TrainingProfile>& training) {
  Chart chart{"part of the marker's diameter", "part of the range", {}};
  const double step = 1 / (static_cast<double>(c.normalised.size()) - 1);
  chart.curves.push_back(curve_of(c.normalised, step, "profile"));
  for (const Neighbour& one : c.reading->neighbours) {
    const TrainingProfile& t = training[one.rank];
    chart.curves.push_back(
        curve_of(t.levels, step,
                 fmt::format("{} blurred at {} degrees: {:.3f}", t.bits, t.orientation_deg, one.distance)));
  }
  return {"classification",
          fmt::format(
              "{} of the {} nearest training profiles say {}; the nearest differs by {:.3f} rms, which is {}",
              c.reading->votes, c.reading->neighbours.size(), c.reading->bits, c.reading->distance(),
              c.accepted ? "accepted" : "too much"),
          chart};
}

/// The one that is explained: the best answer, else the one that came farthest, else the largest.
const Candidate* most_telling(const std::vector<const Candidate*>& answers, const Look& look) {
  if (!answers.empty()) return answers.front();
  const auto rank = [](const Candidate& c) { return std::pair(c.reading.has_value(), c.cluster.size()); };
  const Candidate* best = nullptr;
  for (const Candidate& c : look.candidates)
    if (!c.profile.levels.empty() && (!best || rank(c) > rank(*best))) best = &c;
  return best;
}

Stage answer_stage(const Look& look, const std::vector<const Candidate*>& answers) {
  cv::Mat3b picture = colours_of(look.gray);
  for (const Candidate* c : answers) {
    const Vec2 centre = c->profile.at(c->marks->middle());
    cv::circle(picture, drawn_at(centre), cvRound(c->marks->radius() * (1 << kFractionBits)), kGreen, 2,
               cv::LINE_AA, kFractionBits);
    cv::drawMarker(picture, {cvRound(centre.x), cvRound(centre.y)}, kGreen, cv::MARKER_CROSS, 9);
    cv::putText(picture, c->reading->bits, {cvRound(centre.x) + 6, cvRound(centre.y) - 6},
                cv::FONT_HERSHEY_SIMPLEX, 0.7, kGreen, 2, cv::LINE_AA);
  }
  return {"answer", fmt::format("{} sighting{}", answers.size(), answers.size() == 1 ? "" : "s"), picture};
}

}  // namespace

std::vector<Stage> RingPaperDetector::explain(const Image& image, const std::optional<Box>& where) {
  if (!look_at_part(image, where))
    return {{"answer", "no sightings: the hint lies outside of the picture", cv::Mat()}};
  const std::vector<const Candidate*> answers = accepted();
  std::vector<Stage> stages{
      filter_stage(look_, options_.threshold), components_stage(look_, options_.least_area_px),
      clusters_stage(look_, options_.linkage_px), direction_stage(look_, options_.margin_px)};
  if (const Candidate* c = most_telling(answers, look_)) {
    stages.push_back(profile_stage(*c));
    if (c->reading) stages.push_back(classification_stage(*c, *training_));
  }
  stages.push_back(answer_stage(look_, answers));
  return stages;
}

}  // namespace relock::ring_paper
