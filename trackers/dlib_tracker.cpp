#include "trackers/dlib_tracker.h"

#include <fmt/format.h>

#include "core/error.h"

#ifdef RELOCK_DLIB  // set by CMake where dlib was found
// The second does not compile without the first.
// clang-format off
#include <dlib/image_transforms.h>
#include <dlib/image_processing/correlation_tracker.h>
// clang-format on

#include <cmath>
#include <cstring>

#include "core/opencv.h"
#include "trackers/checked_tracker.h"
#endif

namespace relock {

std::vector<OptionInfo> dlib_option_list() {
  const DlibOptions d;
  return {{"psr_threshold", fmt::format("{}", d.psr_threshold), "",
           "peak-to-sidelobe ratio below which the target is called lost"},
          {"filter_size", fmt::format("{}", d.filter_size), "log2 px",
           "side of the filter; one more is four times slower"},
          {"num_scale_levels", fmt::format("{}", d.num_scale_levels), "log2",
           "sizes tried in each frame; one more is twice as slow"}};
}

DlibOptions dlib_options(const Options& given) {
  return {.psr_threshold = given.number("psr_threshold", 0, 100),
          .filter_size = given.whole("filter_size", 5, 8),
          .num_scale_levels = given.whole("num_scale_levels", 2, 7)};
}

#ifdef RELOCK_DLIB
namespace {

// dlib aborts the program at the second fault that it throws, caught or not: nothing may reach it that it
// could refuse. Its rectangles' edges are where ours are when they are not rounded: its (left + right) / 2 is
// the centre in coordinates with pixel centres at integers. (Rectangles of whole pixels end at the last
// pixel's centre instead; that would only make the box a pixel smaller.)
dlib::drectangle rectangle_of(const Box& box) { return {box.x, box.y, box.right(), box.bottom()}; }
Box box_of(const dlib::drectangle& r) { return {r.left(), r.top(), r.width(), r.height()}; }

class DlibFollower final : public Follower {
 public:
  explicit DlibFollower(const DlibOptions& options)
      : threshold_(options.psr_threshold),
        library_(static_cast<unsigned long>(options.filter_size),
                 static_cast<unsigned long>(options.num_scale_levels)) {}

  void start(const Image& picture, const Box& box) override {
    said_ = search_from_ = box;
    library_.start_track(gray_copy(picture), rectangle_of(box));
  }

  std::optional<Sighting> follow(const Image& picture) override {
    const double psr = library_.update(gray_copy(picture), rectangle_of(search_from_));
    const Box box = box_of(library_.get_position());
    // The ratio is not a number in a picture without contrast.
    const bool usable = psr >= threshold_ / 2 && sound(box, picture.size());
    search_from_ = usable ? box : said_;
    if (!usable || psr < threshold_) return std::nullopt;
    said_ = box;
    Sighting sighting = sighting_of(box);
    sighting.confidence = psr < kHuge ? psr / (psr + 7) : 1;
    return sighting;
  }

 private:
  static constexpr double kHuge = 1e6;

  /// Whether to search from `box`: dlib shrinks it by a quarter in every black frame.
  bool sound(const Box& box, Size picture) const {
    if (!well_formed(box) || share_inside(box, picture_box(picture)) < 0.25) return false;
    const double scale = std::sqrt(box.area() / said_.area());
    return box.width >= 4 && box.height >= 4 && scale >= 0.5 && scale <= 2;
  }

  const dlib::array2d<unsigned char>& gray_copy(const Image& picture) {
    const cv::Mat gray = gray_of(picture, gray_);
    pixels_.set_size(gray.rows, gray.cols);
    for (int y = 0; y < gray.rows; ++y)
      std::memcpy(&pixels_[y][0], gray.ptr(y), static_cast<std::size_t>(gray.cols));
    return pixels_;
  }

  double threshold_;
  dlib::correlation_tracker library_;
  dlib::array2d<unsigned char> pixels_;  // dlib reads only pictures of its own kind
  cv::Mat gray_;
  Box said_;         // the last box that was held
  Box search_from_;  // in the next frame
};

}  // namespace

bool has_dlib() { return true; }
std::unique_ptr<Tracker> dlib_tracker(const DlibOptions& options) {
  return checked_tracker("dlib", [&] { return std::make_unique<DlibFollower>(options); });
}

#else

bool has_dlib() { return false; }
std::unique_ptr<Tracker> dlib_tracker(const DlibOptions&) {
  throw Error("dlib needs the library dlib; this relock was built without it");
}

#endif

}  // namespace relock
