#pragma once

#include <memory>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"

namespace relock {

struct TemplateOptions {
  double least_correlation = 0.5;  ///< below it the target is called lost; blur lowers it, too
  int shrink = 1;  ///< how many times smaller the picture is searched before it is searched closely
};
std::vector<OptionInfo> template_option_list();
/// Throws Error naming the option, the value and the legal range.
TemplateOptions template_options(const Options& given);

/// Looks for the start patch in the whole picture: grey, normalised cross-correlation, to a part of a pixel.
///
/// It knows nothing of the last place, so it finds the target again by itself after any absence, and may find
/// something that looks alike. The patch is never learnt anew, turned or scaled: the box keeps its size.
/// Confidence is the correlation. A start patch without contrast is found nowhere.
///
/// With `shrink` above 1, the best place of a smaller picture is searched closely, at a small part of the
/// cost; fine texture that is lost in the smaller picture misleads it. The patch is not shrunk below 8 px.
std::unique_ptr<Tracker> template_tracker(const TemplateOptions& options);

}  // namespace relock
