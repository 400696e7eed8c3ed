#include "eval/compatibility/ape.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"

namespace relock {
namespace {

using Places = Eigen::Matrix3Xd;

struct Paths {
  Places truth, answer;
};

Paths paths_of(const AnsweredSequence& sequence) {
  std::vector<Vec2> truth, answer;
  for (const AnsweredFrame& frame : sequence.frames) {
    if (frame.given || !frame.truth || !frame.answer) continue;
    truth.push_back(centre_of(*frame.truth));
    answer.push_back(centre_of(*frame.answer));
  }
  const auto places = [](const std::vector<Vec2>& path) {
    Places all = Places::Zero(3, static_cast<Eigen::Index>(path.size()));
    for (std::size_t i = 0; i < path.size(); ++i)
      all.col(static_cast<Eigen::Index>(i)) << path[i].x, path[i].y, 0;
    return all;
  };
  return {places(truth), places(answer)};
}

/// Whether all places lie on one line, so that no rotation can be found.
bool straight(const Places& path) {
  const Places spread = path.colwise() - path.rowwise().mean();
  const Eigen::Vector2d s = Eigen::JacobiSVD<Eigen::MatrixXd>(spread.topRows(2)).singularValues();
  return !(s[1] > 1e-9 * s[0]);
}

void align(Paths& paths, Alignment how, const std::string& sequence) {
  if (how == Alignment::none) return;
  if (paths.truth.cols() < 3 || straight(paths.truth) || straight(paths.answer))
    throw Error(fmt::format("the path on {} is a point or a line and cannot be aligned", sequence));
  const Eigen::Matrix4d fit = Eigen::umeyama(paths.answer, paths.truth, how == Alignment::similarity);
  paths.answer = (fit * paths.answer.colwise().homogeneous()).topRows<3>();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

Alignment parse_alignment(std::string_view text) {
  if (text == "none") return Alignment::none;
  if (text == "rigid") return Alignment::rigid;
  if (text == "similarity") return Alignment::similarity;
  throw Error(fmt::format("there is no alignment \"{}\"; it is none, rigid or similarity", text));
}

ApeScores ape_scores(std::span<const AnsweredSequence> sequences, Alignment alignment) {
  std::vector<double> errors;
  for (const AnsweredSequence& sequence : sequences) {
    Paths paths = paths_of(sequence);
    if (paths.truth.cols() == 0) continue;
    align(paths, alignment, sequence.name);
    for (Eigen::Index i = 0; i < paths.truth.cols(); ++i)
      errors.push_back((paths.truth.col(i) - paths.answer.col(i)).norm());
  }
  ApeScores scores;
  scores.frames = errors.size();
  if (errors.empty()) return scores;
  const auto count = static_cast<double>(errors.size());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  double squares = 0, spread = 0;
  for (const double e : errors) squares += e * e, spread += (e - mean) * (e - mean);
  scores.rmse_px = std::sqrt(squares / count);
  scores.mean_px = mean;
  scores.median_px = median(errors);
  scores.std_px = std::sqrt(spread / count);
  scores.max_px = *std::max_element(errors.begin(), errors.end());
  return scores;
}

}  // namespace relock
