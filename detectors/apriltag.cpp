#include "detectors/apriltag.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagStandard41h12.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/core/mat.hpp>

#include "core/error.h"
#include "core/nearest.h"
#include "core/opencv.h"
#include "detectors/part.h"

namespace relock {
namespace {

// Left out: tagStandard52h13, tagCustom48h12 and tagCircle49h12, whose tables of codes take over 100 MB.
struct NamedFamily {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};
constexpr NamedFamily kFamilies[] = {
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
};

using FamilyPtr = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;
using DetectorPtr = std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)>;
using DetectionsPtr = std::unique_ptr<zarray_t, void (*)(zarray_t*)>;
using ImagePtr = std::unique_ptr<image_u8_t, void (*)(image_u8_t*)>;

/// What image_u8_destroy does; Debian has that one in a library of its own.
void free_image(image_u8_t* image) {
  std::free(image->buf);
  std::free(image);
}

FamilyPtr family_called(const std::string& name) {
  for (const auto& family : kFamilies)
    if (name == family.name) return {family.create(), family.destroy};
  throw Error(fmt::format("apriltag has no family \"{}\"{}", name, did_you_mean(name, apriltag_families())));
}

DetectorPtr detector_of(const ApriltagOptions& options, apriltag_family_t* family) {
  DetectorPtr detector(apriltag_detector_create(), apriltag_detector_destroy);
  detector->quad_decimate = static_cast<float>(options.decimate);
  detector->quad_sigma = static_cast<float>(options.sigma_px);
  detector->nthreads = options.threads;
  apriltag_detector_add_family_bits(detector.get(), family, options.hamming);
  return detector;
}

/// libapriltag wraps the corners the other way round, from the bottom left of the upright tag, and its pixel
/// centres lie at .5.
Quad quad_of(const apriltag_detection_t& tag, Vec2 offset) {
  Quad quad;
  for (std::size_t i = 0; i < 4; ++i)
    quad.corner[3 - i] = Vec2{tag.p[i][0] - 0.5, tag.p[i][1] - 0.5} + offset;
  return quad;
}

class ApriltagDetector final : public Detector {
 public:
  explicit ApriltagDetector(const ApriltagOptions& options)
      : options_(options),
        code_family_(apriltag_family(options)),
        family_(family_called(options.family)),
        detector_(detector_of(options, family_.get())) {}

  Sightings detect(const Image& image, const std::optional<Box>& where) override {
    if (image.empty()) throw Error("apriltag was given an empty picture");
    const Part part = part_to_search(image, where);
    // A smaller picture cannot hold a tag, and the library's tiles do not fit into it.
    if (std::min(part.image.size().width, part.image.size().height) < kLeastPicturePx * options_.decimate)
      return {};
    cv::Mat gray = gray_of(part.image, gray_);
    // With sigma and without decimation the library blurs the very pixels that it is given.
    if (options_.sigma_px != 0 && gray.data != gray_.data) gray = (gray.copyTo(gray_), gray_);
    image_u8_t pixels{gray.cols, gray.rows, static_cast<std::int32_t>(gray.step[0]), gray.data};
    const DetectionsPtr tags(apriltag_detector_detect(detector_.get(), &pixels), apriltag_detections_destroy);
    return sightings(tags.get(), part.offset);
  }

 private:
  Sightings sightings(const zarray_t* tags, Vec2 offset) const {
    Sightings found;
    for (int i = 0; i < zarray_size(tags); ++i) {
      apriltag_detection_t* tag = nullptr;
      zarray_get(tags, i, &tag);
      const Quad quad = quad_of(*tag, offset);
      if (tag->decision_margin < options_.min_margin || !well_formed(quad)) continue;
      found.push_back({.centre = diagonals_meet(quad),
                       .centre_kind = CentreKind::projected,
                       .outline = quad,
                       .code = Code{code_family_, fmt::format("{}", tag->id)},
                       .confidence = std::clamp(tag->decision_margin / 127.5, 0.0, 1.0)});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Sighting& a, const Sighting& b) { return a.confidence > b.confidence; });
    return found;
  }

  static constexpr double kLeastPicturePx = 8;

  ApriltagOptions options_;
  std::string code_family_;
  FamilyPtr family_;
  DetectorPtr detector_;  // after the family, because it lets go of the family when it is destroyed
  cv::Mat gray_;
};

}  // namespace

std::vector<OptionInfo> apriltag_option_list() {
  const ApriltagOptions d;
  return {
      {"family", d.family, "", fmt::format("the set of tags: {}", fmt::join(apriltag_families(), ", "))},
      {"decimate", fmt::format("{}", d.decimate), "",
       "look for tags in a picture this many times smaller; faster, and misses small tags"},
      {"sigma_px", fmt::format("{}", d.sigma_px), "px",
       "Gaussian blur before looking, against noise; below 0 sharpens"},
      {"threads", fmt::format("{}", d.threads), "", "threads of the library"},
      {"hamming", fmt::format("{}", d.hamming), "bits",
       "wrong bits that are corrected; more reads worse pictures and sees more that is not there"},
      {"min_margin", fmt::format("{}", d.min_margin), "grey levels",
       "smallest decision margin believed: how far the average bit is from the threshold"},
  };
}

ApriltagOptions apriltag_options(const Options& given) {
  return {.family = given.word("family", apriltag_families()),
          .decimate = given.number("decimate", 1, 16),
          .sigma_px = given.number("sigma_px", -10, 10),
          .threads = given.whole("threads", 1, 64),
          .hamming = given.whole("hamming", 0, 2),
          .min_margin = given.number("min_margin", 0, 255)};
}

std::string apriltag_family(const ApriltagOptions& options) { return "april" + options.family; }

std::unique_ptr<Detector> apriltag_detector(const ApriltagOptions& options) {
  return std::make_unique<ApriltagDetector>(options);
}

std::vector<std::string> apriltag_families() {
  std::vector<std::string> names;
  for (const auto& family : kFamilies) names.emplace_back(family.name);
  return names;
}

MarkerCells apriltag_cells(const std::string& family, int id) {
  const FamilyPtr tags = family_called(family);
  const int count = static_cast<int>(tags->ncodes);
  if (id < 0 || id >= count)
    throw Error(fmt::format("the family {} has no tag {}; its tags are 0 to {}", family, id, count - 1));
  const ImagePtr print(apriltag_to_image(tags.get(), id), free_image);
  MarkerCells cells{
      .side = print->width, .margin = (tags->total_width - tags->width_at_border) / 2, .grey = {}};
  for (int y = 0; y < print->height; ++y)
    cells.grey.insert(cells.grey.end(), print->buf + y * print->stride,
                      print->buf + y * print->stride + print->width);
  return cells;
}

}  // namespace relock
