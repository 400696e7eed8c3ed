#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/judgement/verdict.h"

namespace relock::reproduction {

/// What a detector made of one picture of a canvas, judged by the evaluator (docs/metrics.md section 3).
struct PictureAnswer {
  double blur_px = 0;
  double angle_deg = 0;  ///< of the blur, from +x towards +y
  Verdict verdict = Verdict::Miss;
  bool uncoded = false;                  ///< a Hit by place alone: no code was read
  std::optional<double> error_px = {};   ///< of the centre; of a Hit, WrongId or Stray
  std::optional<double> along_px = {};   ///< its part along the blur, signed
  std::optional<double> across_px = {};  ///< its part across the blur
  int spurious = 0;                      ///< sightings of nothing

  /// Found, and its code read rightly.
  bool recognised() const { return verdict == Verdict::Hit && !uncoded; }
};

/// Answers as a file keeps them: `made_by`, a line that tells all they depend on, and a row for each picture.
std::string answers_text(const std::string& made_by, const std::vector<PictureAnswer>& answers);
/// Reads them back; nothing when the file is not there or was made by something else. Throws Error with file and
/// line on a file that is not whole.
std::optional<std::vector<PictureAnswer>> read_answers(const std::filesystem::path& file,
                                                       const std::string& made_by, std::size_t pictures);

}  // namespace relock::reproduction
