// Where ring markers may be (detectors/ring/finder.h): how often the true place is among the first, and what finding
// it costs beside OpenCV's ArUco on the same pictures.
// Usage: ring_candidates [STILLS] [SEED] [PART OF A NAME]      100, 1 and all if not given; tuned on even seeds

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "detectors/ring/finder.h"
#include "sequences/simulator/stills.h"

namespace {

using namespace relock;

/// Of this thread: other programs' share of the machine is not counted.
double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Stopwatch {
  double begun = cpu_ms();
  double lap() {
    const double now = cpu_ms(), spent = now - begun;
    begun = now;
    return spent;
  }
};

PrintedTarget sheet(const RingMarker& marker) {
  constexpr int kSide = 512, kPlaces = 4;
  const double radius = marker.geometry.sheet_radius();
  cv::Mat1b picture(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      double sum = 0;
      for (int place = 0; place < kPlaces * kPlaces; ++place) {
        const Vec2 at{2 * (x + (place % kPlaces + 0.5) / kPlaces) / kSide - 1,
                      2 * (y + (place / kPlaces + 0.5) / kPlaces) / kSide - 1};
        sum += reflectance(marker, radius * norm(at));
      }
      picture(y, x) = static_cast<std::uint8_t>(std::lround(255 * sum / (kPlaces * kPlaces)));
    }
  return {.name = "ring:" + marker.bits,
          .code = code_of(marker),
          .outline = PrintedOutline::circle,
          .size_m = 0.15,
          .sheet_m = 0.15 * radius,
          .picture = picture};
}

double radius_along(const Ellipse& ellipse, Vec2 direction) {
  const double turn = std::atan2(direction.y, direction.x) - ellipse.angle_rad;
  return 1 / std::hypot(std::cos(turn) / ellipse.semi_major, std::sin(turn) / ellipse.semi_minor);
}

/// A fit comes home from there: within a third of the radius, of about the right size.
bool is_it(const ring::Candidate& candidate, const Ellipse& truth) {
  const double radius = radius_along(truth, candidate.best.along);
  return norm(candidate.best.middle - truth.centre) < 0.3 * truth.semi_major &&
         candidate.best.radius_px > 0.75 * radius && candidate.best.radius_px < 1.3 * radius;
}

/// What lines and edges alone cost, of what find() does.
double scanning_ms(const ring::Pyramid& pyramid) {
  ring::LineScan scan;
  ring::EdgeFinder edges;
  cv::Mat transposed;
  Stopwatch watch;
  for (std::size_t level = 0; level < ring::Pyramid::kLevels; ++level) {
    if (level > 0) cv::transpose(pyramid.level[level], transposed);
    for (std::size_t direction = 0; direction < ring::kLineDirections.size();
         direction += level == 0 ? 4 : 1) {
      scan.read(pyramid.level[level], transposed, ring::kLineDirections[direction]);
      for (std::size_t rank = 0; rank < scan.size(); ++rank) edges.find(scan[rank], 11);
    }
  }
  return watch.lap();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

struct Setting {
  std::string name;
  simulator::StillPlan plan;
};

std::vector<Setting> settings() {
  using simulator::Backdrop;
  std::vector<Setting> all;
  for (const double blur : {0.0, 50.0, 100.0, 120.0, 150.0})
    all.push_back(
        {fmt::format("plain, D 150, blur {}", blur),
         {.size_px = {150, 150}, .tilt_deg = {0, 0}, .blurs_px = {blur}, .backdrop = Backdrop::plain}});
  for (const double blur : {0.0, 15.0, 30.0})
    all.push_back({fmt::format("clutter, D 60 to 150, blur {}", blur), {.blurs_px = {blur}}});
  for (const double blur : {50.0, 65.0, 80.0, 100.0})
    all.push_back(
        {fmt::format("clutter, D 150, blur {}", blur), {.size_px = {150, 150}, .blurs_px = {blur}}});
  all.push_back({"clutter, D 22, sharp", {.size_px = {22, 22}, .tilt_deg = {0, 20}}});
  all.push_back({"clutter, D 60 to 150, 1080p", {.picture = {1920, 1080}, .focal_widths = 0.9}});
  return all;
}

void measure(const Setting& setting, std::size_t count, std::uint64_t seed) {
  const RingGeometry geometry = paper_ring_geometry();
  std::vector<PrintedTarget> sheets;
  for (const std::string& bits : all_ring_bits(geometry.bits())) sheets.push_back(sheet({geometry, bits}));
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_6X6_250);
  ring::CandidateFinder finder(geometry);
  ring::Pyramid pyramid;
  std::vector<double> building, scanning, finding, aruco;
  std::vector<int> at_rank(5);  // first, second, third, later, none
  for (std::size_t rank = 0; rank < count; ++rank) {
    const simulator::Still still = simulator::still(setting.plan, sheets, rank, seed);
    Stopwatch watch;
    pyramid.build(still.pixels);
    building.push_back(watch.lap());
    const auto& found = finder.find(pyramid);
    finding.push_back(watch.lap());
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(still.pixels, dictionary, corners, ids);
    aruco.push_back(watch.lap());
    scanning.push_back(scanning_ms(pyramid));
    const auto& truth = still.targets[*still.shown];
    const auto& ellipse = std::get<Ellipse>(*truth.outline);
    const auto place = std::find_if(found.begin(), found.end(), [&](const ring::Candidate& candidate) {
      return is_it(candidate, ellipse);
    });
    ++at_rank[place == found.end()
                  ? 4U
                  : std::min<std::size_t>(3, static_cast<std::size_t>(place - found.begin()))];
  }
  const double all = static_cast<double>(count) / 100.0;
  fmt::print("{:30} {:6.1f} {:6.1f} {:6.1f} {:6.1f} {:6.1f}   {:5.2f} {:5.2f} {:6.2f} {:6.2f} {:5.2f}\n",
             setting.name, at_rank[0] / all, (at_rank[0] + at_rank[1]) / all,
             (at_rank[0] + at_rank[1] + at_rank[2]) / all, at_rank[3] / all, at_rank[4] / all,
             median(building), median(scanning), median(finding), median(aruco),
             (median(building) + median(finding)) / median(aruco));
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::stoul(argv[1]) : 100;
  const std::uint64_t seed = argc > 2 ? std::stoull(argv[2]) : 1;
  cv::setNumThreads(1);
  fmt::print(
      "{} stills each, seed {}: the true place among the first candidates, %; medians of CPU time, ms\n\n",
      count, seed);
  fmt::print("{:30} {:>6} {:>6} {:>6} {:>6} {:>6}   {:>5} {:>5} {:>6} {:>6} {:>5}\n", "", "1", "2", "3",
             "later", "none", "pyr.", "scan", "find", "aruco", "ratio");
  const std::string wanted = argc > 3 ? argv[3] : "";
  for (const Setting& setting : settings())
    if (setting.name.find(wanted) != std::string::npos) measure(setting, count, seed);
}
