#include <fmt/format.h>

#include "trackers/opencv_tracker.h"

namespace relock {

std::vector<OptionInfo> kcf_option_list() {
  const KcfOptions d;
  return {
      {"detect_thresh", fmt::format("{}", d.detect_thresh), "",
       "response below which the target is called lost"},
      {"interp_factor", fmt::format("{}", d.interp_factor), "per frame",
       "how fast the model follows the target's looks"},
      {"resize", fmt::format("{}", d.resize), "",
       "halve patches that are larger than max_patch_size, for speed"},
      {"max_patch_size", fmt::format("{}", d.max_patch_size), "px^2", "largest patch that is not halved"}};
}

KcfOptions kcf_options(const Options& given) {
  return {.detect_thresh = given.number("detect_thresh", 0, 1),
          .interp_factor = given.number("interp_factor", 0, 1),
          .resize = given.flag("resize"),
          .max_patch_size = given.whole("max_patch_size", 100, 100'000'000)};
}

std::vector<OptionInfo> csrt_option_list() {
  const CsrtOptions d;
  return {{"psr_threshold", fmt::format("{}", d.psr_threshold), "",
           "peak-to-sidelobe ratio below which the target is called lost"},
          {"template_size_px", fmt::format("{}", d.template_size_px), "px",
           "side to which the patch is scaled; smaller is faster"},
          {"padding", fmt::format("{}", d.padding), "target sizes", "how large the searched area is"},
          {"filter_lr", fmt::format("{}", d.filter_lr), "per frame",
           "how fast the filter follows the target's looks"},
          {"number_of_scales", fmt::format("{}", d.number_of_scales), "", "sizes tried in each frame"},
          {"use_segmentation", fmt::format("{}", d.use_segmentation), "",
           "weigh pixels by how much they look like the target"}};
}

CsrtOptions csrt_options(const Options& given) {
  return {.psr_threshold = given.number("psr_threshold", 0, 1),
          .template_size_px = given.number("template_size_px", 20, 1000),
          .padding = given.number("padding", 1, 10),
          .filter_lr = given.number("filter_lr", 0, 1),
          .number_of_scales = given.whole("number_of_scales", 1, 200),
          .use_segmentation = given.flag("use_segmentation")};
}

std::vector<OptionInfo> mil_option_list() {
  const MilOptions d;
  return {{"search_radius_px", fmt::format("{}", d.search_radius_px), "px",
           "how far from the last place it looks"},
          {"features", fmt::format("{}", d.features), "", "Haar features drawn; more is slower"}};
}

MilOptions mil_options(const Options& given) {
  // OpenCV's MIL finds no negative samples within a smaller radius, and has 250 features written into its
  // code.
  return {.search_radius_px = given.number("search_radius_px", 4, 200),
          .features = given.whole("features", 250, 2000)};
}

}  // namespace relock
