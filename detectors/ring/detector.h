#pragma once

#include <optional>
#include <vector>

#include "core/stage.h"
#include "detectors/ring.h"
#include "detectors/ring/coarse_fit.h"
#include "detectors/ring/finder.h"
#include "detectors/ring/reading.h"

namespace relock::ring {

/// A candidate that was looked at closely and what came of it, as far as it came.
struct Closely {
  const Candidate* candidate = nullptr;
  std::size_t level = 0;           ///< of the pyramid, of the starts
  std::vector<ScoredView> starts;  ///< likeliest first
  std::optional<Fit> coarse = {};  ///< px of the full picture
  std::optional<Reading> read = {};
};

/// Everything that one look at a picture makes.
struct Look {
  cv::Mat gray;  ///< white rings on black: the negative, if the rings are black
  const std::vector<Candidate>* candidates = nullptr;  ///< best first; none: the picture is too small for any
  std::vector<Closely> closely;                        ///< the candidates that were looked at, in their order
  std::vector<Reading> markers;                        ///< best first, each marker once
};

class RingDetector final : public ExplainingDetector {
 public:
  explicit RingDetector(const RingOptions& options);

  Sightings detect(const Image& image, const std::optional<Box>& where) override;
  std::vector<Stage> explain(const Image& image, const std::optional<Box>& where) override;

  /// All that detect() makes of a picture, which must not be empty. Good until the next call, and as long as the
  /// picture's pixels.
  const Look& look(const Image& image);

 private:
  /// Looks at the part of the picture that `where` says; where it begins, or nothing when it is empty.
  std::optional<Vec2> look_at_part(const Image& image, const std::optional<Box>& where);
  cv::Mat white_on_black(const Image& image);
  void look_at_best();
  std::vector<const Candidate*> chosen_candidates();
  Closely look_closely(const Candidate& candidate);
  /// In the tone that is asked for, or the one that explains more.
  std::optional<Reading> read_in_its_tone(const Fit& coarse);
  /// The picture with grey levels proportional to light; made when it is asked for.
  const Pyramid& in_light();
  void refine_markers();
  void look_at_colours(const Image& image);
  Sightings sightings(Vec2 offset) const;

  Stage chords_stage() const;
  Stage fit_stage(const Closely& closely);

  RingOptions options_;
  RingModel model_;
  CandidateFinder finder_;
  Fitter fitter_;
  std::vector<std::string> codes_;
  Pyramid pyramid_, light_pyramid_;
  bool light_is_made_ = false;  // of this picture
  cv::Mat gray_, negative_, light_, channel_;
  Look look_;
};

}  // namespace relock::ring
