// paste_prints - puts two fiducial prints into the klahaag clip, with truth.
//
//   paste_prints KLAHAAG_FOLDER OUT_FOLDER                writes images/ and labels.csv
//   paste_prints --check KLAHAAG_FOLDER LABELS_CSV        computes the labels again and compares them
//
// The prints hang in front of the hedge at the left and of the conifer at the right, and move as the leaves
// around them do. Truth is how they were drawn: nothing is detected.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../frames.h"
#include "print.h"
#include "surface_motion.h"

namespace {

using namespace recordings;
namespace fs = std::filesystem;

constexpr double kExposure = 0.5;  // of the frame interval, around the frame's time
constexpr int kExposureParts = 8;
constexpr int kJpegQuality = 92;
constexpr std::uint64_t kNoiseSeed = 20;
constexpr double kCheckTolerance = 0.05;  // px; other versions of OpenCV round the optical flow otherwise

struct Print {
  std::string target;
  cv::Mat1b cells;
  Quad outline;      // in frame 0, px
  cv::Rect surface;  // in frame 0, px: the texture it moves with
};

std::vector<Print> prints() {
  return {{"apriltag",
           apriltag36h11_cells(5),
           {{{9.0, 31.0}, {58.0, 35.5}, {58.5, 86.0}, {9.5, 88.5}}},
           cv::Rect(0, 15, 130, 95)},
          {"aruco",
           aruco6x6_250_cells(23),
           {{{487.0, 38.0}, {533.0, 36.0}, {533.5, 86.0}, {487.5, 85.0}}},
           cv::Rect(460, 5, 115, 140)}};
}

/// One print through the whole clip.
struct Path {
  Pose first;
  std::vector<cv::Matx33d> from_first;

  // By the parabola through the frame and its neighbours; `offset` in frame intervals, up to half of one.
  Pose pose(std::size_t frame, double offset) const {
    const cv::Matx33d& now = from_first[frame];
    const bool has_before = frame > 0;
    const bool has_after = frame + 1 < from_first.size();
    const cv::Matx33d before = has_before ? from_first[frame - 1] : 2.0 * now - from_first[frame + 1];
    const cv::Matx33d after = has_after ? from_first[frame + 1] : 2.0 * now - from_first[frame - 1];
    const cv::Matx33d speed = 0.5 * (after - before);
    const cv::Matx33d bend = after - 2.0 * now + before;
    return (now + offset * speed + (0.5 * offset * offset) * bend) * first;
  }

  // The middles of equal parts of the exposure.
  std::vector<Pose> exposure(std::size_t frame) const {
    std::vector<Pose> poses;
    for (int i = 0; i < kExposureParts; ++i) {
      poses.push_back(pose(frame, kExposure * ((i + 0.5) / kExposureParts - 0.5)));
    }
    return poses;
  }
};

Path path_of(const Print& print, const std::vector<fs::path>& frames) {
  SurfaceMotion motion = follow_surface(frames, print.surface);
  std::fprintf(stderr, "%s: moves with %.0f features, jitter of a step %.3f px\n", print.target.c_str(),
               motion.features, motion.jitter_px);
  return {pose_of(print.outline), std::move(motion.from_first)};
}

Quad mean_outline(const std::vector<Pose>& exposure) {
  Quad mean{};
  for (const Pose& pose : exposure) {
    const Quad outline = outline_of(pose);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean.at(i) += outline.at(i) * (1.0 / static_cast<double>(exposure.size()));
    }
  }
  return mean;
}

double visible_fraction(const Quad& outline, const cv::Size& size) {
  const std::vector<cv::Point2f> quad(outline.begin(), outline.end());
  const float right = static_cast<float>(size.width) - 0.5F;
  const float bottom = static_cast<float>(size.height) - 0.5F;
  const std::vector<cv::Point2f> picture{{-0.5F, -0.5F}, {right, -0.5F}, {right, bottom}, {-0.5F, bottom}};
  std::vector<cv::Point2f> common;
  const double seen = cv::intersectConvexConvex(quad, picture, common);
  return std::min(1.0, seen / cv::contourArea(quad));
}

std::string print_row(std::size_t frame, const Print& print, const Path& path, const cv::Size& size) {
  const Quad outline = mean_outline(path.exposure(frame));
  const cv::Point2d middle(0.5, 0.5);
  const cv::Point2d blur =
      project(path.pose(frame, kExposure / 2), middle) - project(path.pose(frame, -kExposure / 2), middle);
  std::array<char, 64> cell{};
  std::string row = std::to_string(frame) + "," + print.target + ",,,,,";
  for (const cv::Point2d& corner : outline) {
    std::snprintf(cell.data(), cell.size(), ",%.3f,%.3f", corner.x, corner.y);
    row += cell.data();
  }
  std::snprintf(cell.data(), cell.size(), ",%.3f,%.2f,%.2f", visible_fraction(outline, size), blur.x, blur.y);
  return row + cell.data();
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

struct Clip {
  std::vector<fs::path> frames;
  std::vector<std::string> shirt_rows;  // frame,shirt,visible,x,y,width,height
  std::vector<Print> prints;
  std::vector<Path> paths;
};

Clip read_clip(const fs::path& klahaag) {
  Clip clip{frame_files(klahaag / "images"), lines_of(klahaag / "labels.csv"), prints(), {}};
  clip.shirt_rows.erase(clip.shirt_rows.begin());
  if (clip.shirt_rows.size() != clip.frames.size()) {
    throw std::runtime_error((klahaag / "labels.csv").string() + " does not have one row for every frame");
  }
  for (const Print& print : clip.prints) clip.paths.push_back(path_of(print, clip.frames));
  return clip;
}

std::vector<std::string> labels_of(const Clip& clip) {
  const cv::Size size = read_frame(clip.frames.front()).size();
  std::vector<std::string> rows{
      "frame,target,label,x,y,width,height,x1,y1,x2,y2,x3,y3,x4,y4,visible_fraction,blur_x,blur_y"};
  for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
    rows.push_back(clip.shirt_rows[frame] + std::string(11, ','));
    for (std::size_t i = 0; i < clip.prints.size(); ++i) {
      rows.push_back(print_row(frame, clip.prints[i], clip.paths[i], size));
    }
  }
  return rows;
}

void write_labels(const Clip& clip, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  for (const std::string& row : labels_of(clip)) out << row << '\n';
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

void write_pictures(const Clip& clip, const fs::path& folder) {
  Noise noise(kNoiseSeed);
  for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
    cv::Mat3b picture = read_frame(clip.frames[frame]);
    for (std::size_t i = 0; i < clip.prints.size(); ++i) {
      draw_print(picture, clip.prints[i].cells, clip.paths[i].exposure(frame), Look{}, noise);
    }
    const fs::path file = folder / clip.frames[frame].filename();
    if (!cv::imwrite(file.string(), picture, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality})) {
      throw std::runtime_error("cannot write " + file.string());
    }
  }
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream in(row + ",");
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

// Equal as text, or as numbers within the tolerance.
bool agree(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char* end_a = nullptr;
  char* end_b = nullptr;
  const double value_a = std::strtod(a.c_str(), &end_a);
  const double value_b = std::strtod(b.c_str(), &end_b);
  const bool numbers = !a.empty() && !b.empty() && *end_a == '\0' && *end_b == '\0';
  return numbers && std::abs(value_a - value_b) <= kCheckTolerance;
}

int check(const Clip& clip, const fs::path& file) {
  const auto expected = lines_of(file);
  const auto computed = labels_of(clip);
  if (expected.size() != computed.size()) {
    throw std::runtime_error(file.string() + " has " + std::to_string(expected.size()) + " lines, not " +
                             std::to_string(computed.size()));
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto a = cells_of(expected[i]);
    const auto b = cells_of(computed[i]);
    if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), agree)) {
      throw std::runtime_error(file.string() + ":" + std::to_string(i + 1) + ": is\n  " + expected[i] +
                               "\nbut should be\n  " + computed[i]);
    }
  }
  return 0;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 3 && arguments[0] == "--check") return check(read_clip(arguments[1]), arguments[2]);
  if (arguments.size() == 2 && arguments[0] != "--check") {
    const fs::path out = arguments[1];
    const Clip clip = read_clip(arguments[0]);
    fs::create_directories(out / "images");
    write_labels(clip, out / "labels.csv");
    write_pictures(clip, out / "images");
    return 0;
  }
  std::cerr << "usage: paste_prints KLAHAAG_FOLDER OUT_FOLDER\n"
               "       paste_prints --check KLAHAAG_FOLDER LABELS_CSV\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& problem) {
    std::cerr << "paste_prints: " << problem.what() << '\n';
    return 1;
  }
}
