#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/plot/plot.h"
#include "cli/reproduce/canvas_answers.h"
#include "cli/reproduce/paper.h"

namespace relock::reproduction {

/// How many of the pictures with one length of blur were recognised. The pictures are independent, each with a place
/// and noise of its own, so the interval is Wilson's (docs/metrics.md section 6).
struct Rate {
  double blur_px = 0;
  int pictures = 0;
  int recognised = 0;  ///< found, and the code read rightly
  int wrong_code = 0;  ///< found, and another code read

  double percent() const { return 100.0 * recognised / pictures; }
  Interval interval() const;  ///< of percent()
};
/// One for each length of blur, rising.
std::vector<Rate> rates_by_blur(const std::vector<PictureAnswer>& answers);
/// Nothing when there is none.
std::optional<Rate> rate_at(const std::vector<Rate>& rates, double blur_px);

/// "97 [86, 100]"; "n/a" for none.
std::string rate_text(const std::optional<Rate>& rate);
PlotCurve curve_of(const std::string& name, const std::vector<Rate>& rates);
PlotCurve curve_of(const std::string& name, const paper::PublishedRates& published);
Json json_of(const std::vector<Rate>& rates);

/// "01 departs from what is printed at 60 px (93 % [86, 97], printed 100)": where the printed rate is outside the
/// interval of ours. Nothing when it is outside nowhere.
std::optional<std::string> departures(const std::string& name, const std::vector<Rate>& rates,
                                      const paper::PublishedRates& published);

}  // namespace relock::reproduction
