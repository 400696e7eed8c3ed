#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "cli/labelling/desk.h"

namespace relock {

/// Whether a target's labels are as good as they say: every placed key frame was left out once, and the curve through
/// the others was held against it.
struct LabelCheck {
  std::string target;
  std::vector<KeyResidual> left_out;
  std::size_t by_hand = 0, by_curve = 0, by_detector = 0;  ///< labelled frames
};
std::vector<LabelCheck> check_labels(const LabelDesk& desk);

/// Of the residuals along x and y, how many lie within so many of the stated sigmas; nothing without any.
std::optional<double> share_within(const LabelCheck& check, double sigmas);
/// Root of the mean square along each axis, px.
std::optional<double> rms_px(const LabelCheck& check);

/// In words and tables.
std::string check_text(const LabelDesk& desk, const std::vector<LabelCheck>& checks);

/// The contact sheet: pictures about the labels of each target, the key frames and the frames of which the curve is
/// least sure, enlarged, with the label drawn on them, its sigma, and on key frames how far off the curve without it is.
cv::Mat contact_sheet(const LabelDesk& desk, const std::vector<LabelCheck>& checks);

}  // namespace relock
