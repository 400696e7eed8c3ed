#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/detector.h"
#include "core/picture.h"

namespace relock {

/// One line of a chart.
struct ChartCurve {
  std::string name;  ///< empty: the only one
  std::vector<Vec2> points;
};

/// What is better drawn as curves than as a picture: a profile, a histogram, a score along a line.
struct Chart {
  std::string x, y;  ///< titles of the axes, with their units
  std::vector<ChartCurve> curves;
};

/// One step of a detector's work on one picture, made to be looked at.
struct Stage {
  std::string name;      ///< one word, it becomes part of a file's name: "filter"
  std::string sentence;  ///< what is to be seen, with the figures of this picture
  std::variant<Picture, Chart> shown;
};

/// A detector that can show how it comes to its answer: `relock detect --explain` asks it to.
class ExplainingDetector : public Detector {
 public:
  /// The stages of what detect() does with the same arguments, in their order, the last one its answer. It may
  /// take its time.
  virtual std::vector<Stage> explain(const Image& image, const std::optional<Box>& where = {}) = 0;
};

}  // namespace relock
