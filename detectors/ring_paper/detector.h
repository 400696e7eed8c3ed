#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/stage.h"
#include "detectors/ring_paper.h"
#include "detectors/ring_paper/axis.h"
#include "detectors/ring_paper/clustering.h"
#include "detectors/ring_paper/components.h"
#include "detectors/ring_paper/gabor.h"
#include "detectors/ring_paper/profile.h"
#include "detectors/ring_paper/training.h"

namespace relock::ring_paper {

/// A cluster and what was found out about it, as far as it came.
struct Candidate {
  Cluster cluster;
  Axis axis = {};
  Profile profile = {};
  std::vector<Bar> bars = {};
  std::optional<Marks> marks = {};      ///< of those bars; none: their number or widths are not allowable
  std::vector<float> normalised = {};   ///< what was classified
  std::optional<Reading> reading = {};  ///< of the marks whose profile is nearest to a training profile
  bool accepted = false;
};

/// Everything that one look at a picture makes; what is in a picture is in its coordinates.
struct Look {
  cv::Mat1b gray;
  cv::Mat1f response;  ///< normalised: 1 is the peak
  cv::Mat1b binary;    ///< 255 above the threshold
  Components components;
  std::vector<Candidate> candidates;
};

class RingPaperDetector final : public ExplainingDetector {
 public:
  explicit RingPaperDetector(const RingPaperOptions& options);

  Sightings detect(const Image& image, const std::optional<Box>& where) override;
  std::vector<Stage> explain(const Image& image, const std::optional<Box>& where) override;

  /// The paper's figure 6: all that detect() makes of a picture, which must not be empty. Good until the next call, and as long as
  /// the picture's pixels.
  const Look& look(const Image& image);

 private:
  /// Looks at the part of the picture that `where` says; where it begins, or nothing when it is empty.
  std::optional<Vec2> look_at_part(const Image& image, const std::optional<Box>& where);
  cv::Mat1b bright_rings(const Image& image);
  cv::Mat1f normalised_response(const cv::Mat1b& gray);
  Profile profile_along(const Axis& axis) const;
  void read_bars(Candidate& candidate) const;
  std::vector<const Candidate*> accepted() const;  ///< best first
  Sightings sightings(Vec2 offset) const;

  RingPaperOptions options_;
  GaborBank bank_;
  std::shared_ptr<const std::vector<TrainingProfile>> training_;
  cv::Mat gray_;
  Look look_;
};

}  // namespace relock::ring_paper
