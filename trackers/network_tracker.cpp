#include "trackers/network_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/opencv_modules.hpp>

#include "core/error.h"
#include "trackers/opencv_follower.h"

#define RELOCK_OPENCV_FROM(major, minor) \
  (CV_VERSION_MAJOR > (major) || (CV_VERSION_MAJOR == (major) && CV_VERSION_MINOR >= (minor)))

namespace relock {
namespace {

struct File {
  const char* option;
  const std::string& path;
  const char* published;  ///< where such a file is to be had
};

constexpr const char* kZoo = "the OpenCV model zoo publishes it";
constexpr const char* kExtra = "OpenCV's collection of test data, opencv_extra, says where it is published";
[[maybe_unused]] constexpr const char* kSamples =
    "OpenCV's sample for its trackers says where it is published";

/// OpenCV's own messages say neither which option is meant nor what to do.
void check_file(const char* tracker, const File& file) {
  const auto refuse = [&](const std::string& why) {
    throw Error(fmt::format("{}: option {} {}; {}", tracker, file.option, why, file.published));
  };
  if (file.path.empty()) refuse("is not given, and relock brings no networks");
  std::error_code fault;
  const auto status = std::filesystem::status(file.path, fault);
  if (!std::filesystem::exists(status)) refuse(fmt::format("is {}, which does not exist", file.path));
  if (std::filesystem::is_directory(status)) refuse(fmt::format("is {}, which is a folder", file.path));
  if (std::ifstream in(file.path, std::ios::binary); !in || in.peek() == std::ifstream::traits_type::eof())
    refuse(fmt::format("is {}, which cannot be read or is empty", file.path));
}

std::string joined(const std::vector<File>& files) {
  std::string all;
  for (const File& file : files)
    if (all.find(file.path) == std::string::npos) all += (all.empty() ? "" : " or ") + file.path;
  return all;
}

/// Checks the files and loads them by `create`. Throws Error.
template <class Create>
auto loaded(const char* tracker, const std::vector<File>& files, const Create& create) {
  for (const File& file : files) check_file(tracker, file);
  // OpenCV logs what it throws, which would be said twice.
  namespace logging = cv::utils::logging;
  const auto level = logging::setLogLevel(logging::LOG_LEVEL_SILENT);
  try {
    auto library = create();
    logging::setLogLevel(level);
    return library;
  } catch (const std::exception& fault) {
    logging::setLogLevel(level);
    std::string said = fault.what();
    if (const auto* from_opencv = dynamic_cast<const cv::Exception*>(&fault)) said = from_opencv->err;
    std::replace(said.begin(), said.end(), '\n', ' ');
    throw Error(fmt::format("{}: {} is no network that OpenCV {} can load; it says \"{}\"", tracker,
                            joined(files), CV_VERSION, said));
  }
}

/// One that gives its answers a score.
template <class LibraryTracker>
class ScoredFollower final : public OpencvFollower<LibraryTracker> {
 public:
  ScoredFollower(cv::Ptr<LibraryTracker> library, double threshold)
      : OpencvFollower<LibraryTracker>(std::move(library)), threshold_(threshold) {}

  std::optional<Sighting> follow(const Image& picture) override {
    auto sighting = OpencvFollower<LibraryTracker>::follow(picture);
    const double score = this->library().getTrackingScore();
    if (!sighting || !(score >= threshold_)) return std::nullopt;
    sighting->confidence = std::clamp(score, 0.0, 1.0);
    return sighting;
  }

 private:
  double threshold_;
};

/// What this build lacks for a tracker that came with OpenCV 4.`minor`; empty: nothing.
[[maybe_unused]] std::string lacks(int minor) {
#ifndef HAVE_OPENCV_DNN
  (void)minor;
  return "an OpenCV with its module dnn";
#else
  if (CV_VERSION_MAJOR > 4 || CV_VERSION_MINOR >= minor) return "";
  return fmt::format("OpenCV 4.{} or newer", minor);
#endif
}

std::string needs(int minor, const char* files) {
  const std::string lacking = lacks(minor);
  return lacking.empty() ? files : lacking;
}

void check_build(const char* tracker, int minor) {
  if (const std::string lacking = lacks(minor); !lacking.empty())
    throw Error(fmt::format("{} needs {}; this relock was built with {}.{}", tracker, lacking,
                            CV_VERSION_MAJOR, CV_VERSION_MINOR));
}

}  // namespace

std::string goturn_needs() { return needs(5, "files: options model, weights"); }
std::string dasiamrpn_needs() { return needs(5, "files: options model, kernel_cls1, kernel_r1"); }
std::string nano_needs() { return needs(7, "files: options backbone, head"); }
std::string vit_needs() { return needs(9, "a file: option model"); }

std::unique_ptr<Tracker> goturn_tracker(const GoturnOptions& options) {
  check_build("goturn", 5);
  return checked_tracker("goturn", [&] {
    cv::TrackerGOTURN::Params p;
    p.modelTxt = options.model;
    p.modelBin = options.weights;
    return std::make_unique<OpencvFollower<cv::Tracker>>(
        loaded("goturn", {{"model", options.model, kExtra}, {"weights", options.weights, kExtra}},
               [&] { return cv::TrackerGOTURN::create(p); }));
  });
}

std::unique_ptr<Tracker> dasiamrpn_tracker(const DasiamrpnOptions& options) {
  check_build("dasiamrpn", 5);
  return checked_tracker("dasiamrpn", [&] {
    cv::TrackerDaSiamRPN::Params p;
    p.model = options.model;
    p.kernel_cls1 = options.kernel_cls1;
    p.kernel_r1 = options.kernel_r1;
    return std::make_unique<ScoredFollower<cv::TrackerDaSiamRPN>>(
        loaded("dasiamrpn",
               {{"model", options.model, kZoo},
                {"kernel_cls1", options.kernel_cls1, kZoo},
                {"kernel_r1", options.kernel_r1, kZoo}},
               [&] { return cv::TrackerDaSiamRPN::create(p); }),
        options.score_threshold);
  });
}

std::unique_ptr<Tracker> nano_tracker([[maybe_unused]] const NanoOptions& options) {
  check_build("nano", 7);
#if RELOCK_OPENCV_FROM(4, 7)
  return checked_tracker("nano", [&] {
    cv::TrackerNano::Params p;
    p.backbone = options.backbone;
    p.neckhead = options.head;
    return std::make_unique<ScoredFollower<cv::TrackerNano>>(
        loaded("nano", {{"backbone", options.backbone, kSamples}, {"head", options.head, kSamples}},
               [&] { return cv::TrackerNano::create(p); }),
        options.score_threshold);
  });
#else
  return nullptr;  // check_build has thrown
#endif
}

std::unique_ptr<Tracker> vit_tracker([[maybe_unused]] const VitOptions& options) {
  check_build("vit", 9);
#if RELOCK_OPENCV_FROM(4, 9)
  return checked_tracker("vit", [&] {
    cv::TrackerVit::Params p;
    p.net = options.model;
    return std::make_unique<ScoredFollower<cv::TrackerVit>>(
        loaded("vit", {{"model", options.model, kZoo}}, [&] { return cv::TrackerVit::create(p); }),
        options.score_threshold);
  });
#else
  return nullptr;  // check_build has thrown
#endif
}

}  // namespace relock
