// label_shirt - finds the orange shirt of the klahaag clip by its colour alone.
//
//   label_shirt IMAGES_FOLDER > labels.csv
//   label_shirt --compare keyframes_hand.csv IMAGES_FOLDER
//
// Every picture is judged on its own: no tracking, no motion, no appearance model. What is measured is
// redness, R - (G + B) / 2, in which the shirt stands at 90 to 160, skin at 70 and blossom at 50 at most. A
// tail light reaches 110, but is small. The box is the shirt with its sleeves, without collar, arms and
// trousers.
//
// Coordinates: pixel centres at integers; a box over the pixel columns 10..19 has x = 9.5, width = 10.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "../frames.h"

namespace {

using recordings::frame_files;
using recordings::read_frame;

constexpr double kSurelyShirt = 90;    // redness that nothing else in the clip reaches over a large area
constexpr double kOutlineLevel = 0.4;  // the outline, in shirt colours: skin stays below, lit sleeves above
constexpr double kSoftness = 0.25;     // half the width of the ramp around it, in shirt colours
constexpr double kColumnLevel = 0.1;   // box from this share of the fullest column: sleeves are short,
constexpr double kRowLevel = 0.2;      // of the fullest row: the collar is skin

cv::Mat1f redness(const cv::Mat3b& picture) {
  cv::Mat1f red(picture.size());
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const cv::Vec3b& bgr = picture(y, x);
      red(y, x) = static_cast<float>(bgr[2] - 0.5 * (bgr[1] + bgr[0]));
    }
  }
  return red;
}

cv::Mat1b above(const cv::Mat1f& values, double level) {
  cv::Mat1b mask;
  cv::compare(values, level, mask, cv::CMP_GT);
  return mask;
}

cv::Mat1b largest_component(const cv::Mat1b& mask) {
  cv::Mat1i labels;
  cv::Mat1i stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centres, 4, CV_32S);
  if (count < 2) throw std::runtime_error("no orange shirt in the picture");
  int best = 1;
  for (int i = 2; i < count; ++i) {
    if (stats(i, cv::CC_STAT_AREA) > stats(best, cv::CC_STAT_AREA)) best = i;
  }
  cv::Mat1b component;
  cv::compare(labels, best, component, cv::CMP_EQ);
  return component;
}

// The white print on the back belongs to the shirt.
cv::Mat1b without_holes(const cv::Mat1b& mask) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::Mat1b filled(mask.size(), 0);
  cv::drawContours(filled, outlines, -1, cv::Scalar(255), cv::FILLED);
  return filled;
}

float median_inside(const cv::Mat1f& values, const cv::Mat1b& mask) {
  std::vector<float> inside;
  for (int y = 0; y < values.rows; ++y) {
    for (int x = 0; x < values.cols; ++x) {
      if (mask(y, x) != 0) inside.push_back(values(y, x));
    }
  }
  const auto middle = inside.begin() + static_cast<std::ptrdiff_t>(inside.size() / 2);
  std::nth_element(inside.begin(), middle, inside.end());
  return *middle;
}

// How much of each pixel is shirt, 0..1. Hysteresis: `core` is surely shirt, and what is joined to it and
// redder than the outline's level is shirt too. The ramp around that level makes the edges finer than a
// pixel.
cv::Mat1f membership(const cv::Mat1f& red, const cv::Mat1b& core) {
  const double full = median_inside(red, core);
  const double foot = kOutlineLevel - kSoftness;
  cv::Mat1b around;
  cv::bitwise_or(core, above(red, kOutlineLevel * full), around);
  around = largest_component(around);
  const cv::Mat1b filled = without_holes(around);
  cv::Mat1b near_shirt;  // the ramp reaches one or two pixels beyond the outline
  cv::dilate(filled, near_shirt, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  cv::Mat1b inner;  // holes count fully, the outline by the ramp
  cv::erode(filled, inner, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));

  cv::Mat1f part(red.size(), 0.0F);
  for (int y = 0; y < part.rows; ++y) {
    for (int x = 0; x < part.cols; ++x) {
      const double ramp = (red(y, x) / full - foot) / (2 * kSoftness);
      if (near_shirt(y, x) != 0) part(y, x) = static_cast<float>(std::clamp(ramp, 0.0, 1.0));
      if (inner(y, x) != 0) part(y, x) = 1;
    }
  }
  return part;
}

struct Span {
  double low = 0;
  double high = 0;
};

// Where the profile first and last crosses this share of its greatest value. Sample i stands for the pixel
// i - 0.5 .. i + 0.5, so an ideal edge between the pixels 9 and 10 is found at 9.5.
Span crossings(const std::vector<double>& profile, double share) {
  const double level = share * *std::max_element(profile.begin(), profile.end());
  const auto value = [&](std::ptrdiff_t i) { return profile.at(static_cast<std::size_t>(i)); };
  std::ptrdiff_t first = 0;
  std::ptrdiff_t last = static_cast<std::ptrdiff_t>(profile.size()) - 1;
  while (value(first) < level) ++first;
  while (value(last) < level) --last;
  const auto between = [&](std::ptrdiff_t outside, std::ptrdiff_t inside) {
    const double t = (level - value(outside)) / (value(inside) - value(outside));
    return static_cast<double>(outside) + t * static_cast<double>(inside - outside);
  };
  return {between(first - 1, first), between(last + 1, last)};
}

cv::Rect2d shirt_box(const cv::Mat3b& picture) {
  const cv::Mat1f red = redness(picture);
  const cv::Mat1b core = largest_component(above(red, kSurelyShirt));
  const cv::Mat1f part = membership(red, core);

  std::vector<double> columns(static_cast<std::size_t>(part.cols), 0.0);
  std::vector<double> rows(static_cast<std::size_t>(part.rows), 0.0);
  for (int y = 0; y < part.rows; ++y) {
    for (int x = 0; x < part.cols; ++x) {
      columns[static_cast<std::size_t>(x)] += part(y, x);
      rows[static_cast<std::size_t>(y)] += part(y, x);
    }
  }
  const Span across = crossings(columns, kColumnLevel);
  const Span down = crossings(rows, kRowLevel);
  return {across.low, down.low, across.high - across.low, down.high - down.low};
}

std::map<std::string, cv::Rect2d> boxes_in(const std::string& folder) {
  std::map<std::string, cv::Rect2d> boxes;
  for (const auto& file : frame_files(folder)) boxes[file.filename().string()] = shirt_box(read_frame(file));
  return boxes;
}

void print_labels(const std::map<std::string, cv::Rect2d>& boxes) {
  std::printf("frame,target,label,x,y,width,height\n");
  int frame = 0;
  for (const auto& [name, box] : boxes) {
    std::printf("%d,shirt,visible,%.2f,%.2f,%.2f,%.2f\n", frame++, box.x, box.y, box.width, box.height);
  }
}

// Hand boxes have the left top PIXEL at x, y: half a pixel right of and below the edge.
std::map<std::string, cv::Rect2d> read_hand_boxes(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  std::map<std::string, cv::Rect2d> boxes;
  std::string line;
  std::getline(in, line);  // file,index,x,y,w,h
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    std::string name;
    int index = 0;
    cv::Rect2d box;
    if (!(cells >> name >> index >> box.x >> box.y >> box.width >> box.height)) {
      throw std::runtime_error(file + ": not a box: " + line);
    }
    boxes[name] = {box.x - 0.5, box.y - 0.5, box.width, box.height};
  }
  return boxes;
}

cv::Point2d centre(const cv::Rect2d& box) { return {box.x + box.width / 2, box.y + box.height / 2}; }

struct Summary {
  double mean = 0;
  double rms = 0;
  double largest = 0;
};

Summary summary(const std::vector<double>& values) {
  Summary all;
  for (const double v : values) {
    all.mean += v / static_cast<double>(values.size());
    all.rms += v * v / static_cast<double>(values.size());
    all.largest = std::max(all.largest, std::abs(v));
  }
  all.rms = std::sqrt(all.rms);
  return all;
}

void print_summary(const char* what, const std::vector<double>& values) {
  const Summary s = summary(values);
  std::printf("%-22s mean %+6.2f  rms %5.2f  largest %5.2f\n", what, s.mean, s.rms, s.largest);
}

// Second differences of a smooth path are the noise of its points, times sqrt(6), plus true acceleration:
// an upper bound of the noise.
void print_smoothness(const char* what, const std::vector<double>& path) {
  std::vector<double> bends;
  for (std::size_t i = 2; i < path.size(); ++i) {
    bends.push_back((path[i] - 2 * path[i - 1] + path[i - 2]) / std::sqrt(6.0));
  }
  print_summary(what, bends);
}

void print_agreement(const std::map<std::string, cv::Rect2d>& hand,
                     const std::map<std::string, cv::Rect2d>& colour) {
  std::printf("colour minus hand, px\n");
  std::printf("%-10s %7s %7s %7s %7s\n", "file", "centre", "centre", "width", "height");
  std::vector<double> dx, dy, dw, dh;
  for (const auto& [name, box] : hand) {
    const cv::Rect2d& found = colour.at(name);
    dx.push_back(centre(found).x - centre(box).x);
    dy.push_back(centre(found).y - centre(box).y);
    dw.push_back(found.width - box.width);
    dh.push_back(found.height - box.height);
    std::printf("%-10s %+7.2f %+7.2f %+7.2f %+7.2f\n", name.c_str(), dx.back(), dy.back(), dw.back(),
                dh.back());
  }
  print_summary("centre x", dx);
  print_summary("centre y", dy);
  print_summary("width", dw);
  print_summary("height", dh);

  std::vector<double> x, y, width, height;
  for (const auto& [name, box] : colour) {
    x.push_back(centre(box).x);
    y.push_back(centre(box).y);
    width.push_back(box.width);
    height.push_back(box.height);
  }
  std::printf("second difference / sqrt(6) over all frames, px: noise and acceleration together\n");
  print_smoothness("centre x", x);
  print_smoothness("centre y", y);
  print_smoothness("width", width);
  print_smoothness("height", height);
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1) {
    print_labels(boxes_in(arguments[0]));
    return 0;
  }
  if (arguments.size() == 3 && arguments[0] == "--compare") {
    print_agreement(read_hand_boxes(arguments[1]), boxes_in(arguments[2]));
    return 0;
  }
  std::cerr << "usage: label_shirt IMAGES_FOLDER > labels.csv\n"
               "       label_shirt --compare keyframes_hand.csv IMAGES_FOLDER\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& problem) {
    std::cerr << "label_shirt: " << problem.what() << '\n';
    return 1;
  }
}
