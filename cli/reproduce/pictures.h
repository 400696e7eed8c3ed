#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "cli/reproduce/experiment.h"
#include "core/sighting.h"

namespace relock::reproduction {

// Pictures are chosen by what is true of them, never by what a detector made of them, and their captions say whether
// the ring was found.

/// A ring of each code in a simulated flight, blurred, with what was seen drawn into it.
std::vector<Finding> figure_8(const Settings& settings, const Methods& methods);
/// Four rings in one picture.
std::vector<Finding> figure_9(const Settings& settings, const Methods& methods);
/// Rings on the canvas under blur beyond 50 px, over lengths and angles.
std::vector<Finding> figure_10(const Settings& settings, const Methods& methods);

/// The picture in colour with all sightings drawn into it, each labelled by its code as the paper does: the decimal
/// equivalent of the binary number.
cv::Mat with_answers(const cv::Mat& picture, const Sightings& sightings);
/// The same picture above a line of text.
cv::Mat captioned(const cv::Mat& picture, const std::string& caption);
/// Pictures of one size, side by side in rows of `columns`.
cv::Mat in_rows(const std::vector<cv::Mat>& pictures, int columns);
/// Writes OUT/ID.png and returns its name; with --quick OUT/ID-QUICK.png, with that word at the top.
std::filesystem::path write_figure(const Settings& settings, const std::string& id, const cv::Mat& picture);

}  // namespace relock::reproduction
