#include "detectors/aruco.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/nearest.h"
#include "core/opencv.h"
#include "core/stage.h"
#include "detectors/aruco_library.h"
#include "detectors/part.h"

namespace relock {
namespace {

struct NamedDictionary {
  const char* name;
  int number;
};
constexpr NamedDictionary kDictionaries[] = {
    {"4x4_50", cv::aruco::DICT_4X4_50},           {"4x4_100", cv::aruco::DICT_4X4_100},
    {"4x4_250", cv::aruco::DICT_4X4_250},         {"4x4_1000", cv::aruco::DICT_4X4_1000},
    {"5x5_50", cv::aruco::DICT_5X5_50},           {"5x5_100", cv::aruco::DICT_5X5_100},
    {"5x5_250", cv::aruco::DICT_5X5_250},         {"5x5_1000", cv::aruco::DICT_5X5_1000},
    {"6x6_50", cv::aruco::DICT_6X6_50},           {"6x6_100", cv::aruco::DICT_6X6_100},
    {"6x6_250", cv::aruco::DICT_6X6_250},         {"6x6_1000", cv::aruco::DICT_6X6_1000},
    {"7x7_50", cv::aruco::DICT_7X7_50},           {"7x7_100", cv::aruco::DICT_7X7_100},
    {"7x7_250", cv::aruco::DICT_7X7_250},         {"7x7_1000", cv::aruco::DICT_7X7_1000},
    {"original", cv::aruco::DICT_ARUCO_ORIGINAL},
};

cv::aruco::Dictionary dictionary_called(const std::string& name) {
  for (const auto& dictionary : kDictionaries)
    if (name == dictionary.name) return aruco_library::dictionary(dictionary.number);
  throw Error(
      fmt::format("aruco has no dictionary \"{}\"{}", name, did_you_mean(name, aruco_dictionaries())));
}

cv::aruco::DetectorParameters parameters_of(const ArucoOptions& options) {
  cv::aruco::DetectorParameters parameters;
  // OpenCV's 0.05 (before 4.9) takes a print with a narrow white margin for one with the edge of its paper,
  // keeps the paper and reads nothing. What is found twice because of the smaller value, `same_marker` drops.
  parameters.minMarkerDistanceRate = 0.02;
  parameters.errorCorrectionRate = options.error_correction;
  parameters.adaptiveThreshConstant = options.threshold_constant;
  parameters.cornerRefinementMethod =
      options.corner_refinement == "none" ? cv::aruco::CORNER_REFINE_NONE : cv::aruco::CORNER_REFINE_CONTOUR;
  return parameters;
}

Quad quad_of(const std::vector<cv::Point2f>& corners, Vec2 offset) {
  Quad quad;
  for (std::size_t i = 0; i < 4; ++i) quad.corner[i] = Vec2{corners[i].x, corners[i].y} + offset;
  return quad;
}

// Okabe and Ito's green and orange, as BGR.
const cv::Scalar kGreen(115, 158, 0), kOrange(0, 94, 213);

void draw(cv::Mat& canvas, const Quad& quad, const cv::Scalar& colour) {
  std::vector<cv::Point> corners;
  for (const Vec2& corner : quad.corner) corners.emplace_back(cv::Point2d(corner.x, corner.y));
  cv::polylines(canvas, corners, true, colour, 1, cv::LINE_AA);
}

std::string count_of(const Sightings& found) {
  return found.size() == 1 ? "1 marker" : fmt::format("{} markers", found.size());
}

/// Whether `a` is `b` once more: the inner edge of a border found beside its outer edge, say.
bool same_marker(const Sighting& a, const Sighting& b) {
  return a.code == b.code &&
         norm(a.centre - b.centre) < 0.5 * std::max(size_of(a.outline), size_of(b.outline));
}

class ArucoDetector final : public ExplainingDetector {
 public:
  explicit ArucoDetector(const ArucoOptions& options)
      : options_(options),
        family_(aruco_family(options)),
        dictionary_(dictionary_called(options.dictionary)),
        parameters_(parameters_of(options)) {}

  Sightings detect(const Image& image, const std::optional<Box>& where) override {
    if (image.empty()) throw Error("aruco was given an empty picture");
    const Part part = part_to_search(image, where);
    // A smaller picture cannot hold a marker, and the library's windows do not fit into it.
    corners_.clear(), ids_.clear(), rejected_.clear();
    if (std::min(part.image.size().width, part.image.size().height) < options_.min_side_px) return {};
    const cv::Mat gray = gray_of(part.image, gray_);
    // The library takes the smallest perimeter relative to the picture; a cropped picture must not change it.
    parameters_.minMarkerPerimeterRate = 4 * options_.min_side_px / std::max(gray.cols, gray.rows);
    aruco_library::detect(gray, dictionary_, parameters_, corners_, ids_, rejected_);
    if (options_.corner_refinement == "subpix") refine(gray);
    return sightings(part.offset);
  }

  std::vector<Stage> explain(const Image& image, const std::optional<Box>& where) override {
    const Sightings found = detect(image, where);
    const Part part = part_to_search(image, where);
    std::vector<Stage> stages;
    if (!part.image.empty()) stages.push_back(threshold_stage(part));  // a hint may lie beside the picture
    stages.push_back(candidates_stage(image, part.offset));
    stages.push_back(answer_stage(image, found));
    return stages;
  }

 private:
  Stage threshold_stage(const Part& part) {
    // As the library does it, with each of its windows in turn.
    const int window = parameters_.adaptiveThreshWinSizeMax;
    cv::Mat black;
    cv::adaptiveThreshold(gray_of(part.image, gray_), black, 255, cv::ADAPTIVE_THRESH_MEAN_C,
                          cv::THRESH_BINARY_INV, window, parameters_.adaptiveThreshConstant);
    return {
        "threshold",
        fmt::format("white is what is {} grey levels or more below the mean of the {} px around it; from {} "
                    "px on, windows are tried in steps of {} px",
                    parameters_.adaptiveThreshConstant, window, parameters_.adaptiveThreshWinSizeMin,
                    parameters_.adaptiveThreshWinSizeStep),
        black};
  }

  Stage candidates_stage(const Image& image, Vec2 offset) const {
    cv::Mat canvas;
    bgr_copy(image, canvas);
    for (const auto& corners : rejected_) draw(canvas, quad_of(corners, offset), kOrange);
    for (const auto& corners : corners_) draw(canvas, quad_of(corners, offset), kGreen);
    return {"candidates",
            fmt::format("{} outlines with four corners; the bits in {} of them are a marker's of {} (green)",
                        rejected_.size() + corners_.size(), corners_.size(), options_.dictionary),
            canvas};
  }

  static Stage answer_stage(const Image& image, const Sightings& found) {
    cv::Mat canvas;
    bgr_copy(image, canvas);
    for (const Sighting& sighting : found) draw(canvas, std::get<Quad>(sighting.outline), kGreen);
    return {"answer", fmt::format("{}; what was found twice is told once", count_of(found)), canvas};
  }

  /// Done here, because the library's own window had a fixed size before OpenCV 4.9, which takes in the first
  /// cells of small markers. Where half a cell leaves no window, the lines through the contour are better.
  void refine(const cv::Mat& gray) {
    for (auto& corners : corners_) {
      const double cell = size_of(quad_of(corners, {})) / (dictionary_.markerSize + 2);
      const int reach = std::min(static_cast<int>(kReachCells * cell), kMostReachPx);
      // cornerSubPix asks for a picture of this size.
      if (reach < kLeastReachPx || std::min(gray.cols, gray.rows) < 2 * reach + 5) continue;
      cv::cornerSubPix(gray, corners, {reach, reach}, {-1, -1},
                       {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01});
    }
  }

  Sightings sightings(Vec2 offset) const {
    Sightings all;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const Quad quad = quad_of(corners_[i], offset);
      if (!well_formed(quad)) continue;
      all.push_back({.centre = diagonals_meet(quad),
                     .centre_kind = CentreKind::projected,
                     .outline = quad,
                     .code = Code{family_, fmt::format("{}", ids_[i])}});
    }
    std::stable_sort(all.begin(), all.end(), [](const Sighting& a, const Sighting& b) {
      return size_of(a.outline) > size_of(b.outline);
    });
    Sightings found;
    for (const Sighting& one : all)
      if (std::none_of(found.begin(), found.end(), [&](const Sighting& f) { return same_marker(f, one); }))
        found.push_back(one);
    return found;
  }

  static constexpr double kReachCells = 0.5;
  static constexpr int kLeastReachPx = 2, kMostReachPx = 5;

  ArucoOptions options_;
  std::string family_;
  cv::aruco::Dictionary dictionary_;
  cv::aruco::DetectorParameters parameters_;
  cv::Mat gray_;
  aruco_library::Corners corners_;
  std::vector<int> ids_;
  aruco_library::Corners rejected_;
};

}  // namespace

std::vector<OptionInfo> aruco_option_list() {
  const ArucoOptions d;
  return {
      {"dictionary", d.dictionary, "",
       "the set of markers: 4x4_50, 4x4_100, 4x4_250, 4x4_1000, 5x5_50 … 7x7_1000 or original"},
      {"corner_refinement", d.corner_refinement, "",
       "how corners are made finer than a pixel: none, subpix or contour"},
      {"min_side_px", fmt::format("{}", d.min_side_px), "px", "smallest marker looked for"},
      {"error_correction", fmt::format("{}", d.error_correction), "",
       "part of the bits that the dictionary could correct which is corrected; 0 takes perfect readings "
       "only"},
      {"threshold_constant", fmt::format("{}", d.threshold_constant), "grey levels",
       "how far below the mean of its neighbourhood a pixel is called black; less finds fainter markers"},
  };
}

ArucoOptions aruco_options(const Options& given) {
  return {.dictionary = given.word("dictionary", aruco_dictionaries()),
          .corner_refinement = given.word("corner_refinement", {"none", "subpix", "contour"}),
          .min_side_px = given.number("min_side_px", 4, 10000),
          .error_correction = given.number("error_correction", 0, 1),
          .threshold_constant = given.number("threshold_constant", 0, 255)};
}

std::string aruco_family(const ArucoOptions& options) { return "aruco" + options.dictionary; }

std::unique_ptr<Detector> aruco_detector(const ArucoOptions& options) {
  return std::make_unique<ArucoDetector>(options);
}

std::vector<std::string> aruco_dictionaries() {
  std::vector<std::string> names;
  for (const auto& dictionary : kDictionaries) names.emplace_back(dictionary.name);
  return names;
}

MarkerCells aruco_cells(const std::string& dictionary, int id) {
  const cv::aruco::Dictionary words = dictionary_called(dictionary);
  if (id < 0 || id >= words.bytesList.rows)
    throw Error(fmt::format("the dictionary {} has no marker {}; its markers are 0 to {}", dictionary, id,
                            words.bytesList.rows - 1));
  const int bits = words.markerSize;
  const cv::Mat word = cv::aruco::Dictionary::getBitsFromByteList(words.bytesList.row(id), bits);
  cv::Mat1b print(bits + 4, bits + 4, std::uint8_t{255});
  print(cv::Rect(1, 1, bits + 2, bits + 2)) = std::uint8_t{0};
  cv::Mat(255 * word).copyTo(print(cv::Rect(2, 2, bits, bits)));
  return {.side = print.rows, .margin = 1, .grey = {print.begin(), print.end()}};
}

}  // namespace relock
