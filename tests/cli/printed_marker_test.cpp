// What relock marker prints: measured on its pictures, and read back by our own detectors.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/print/output.h"
#include "cli/print/sheet.h"
#include "cli/print/targets.h"
#include "core/error.h"
#include "core/opencv.h"
#include "detectors/apriltag.h"
#include "detectors/aruco.h"

namespace relock {
namespace {

constexpr double kDpi = 150, kDotsPerMm = kDpi / 25.4;

cv::Mat1b decoded(const std::string& file) {
  return cv::imdecode(std::vector<char>(file.begin(), file.end()), cv::IMREAD_GRAYSCALE);
}

std::vector<Design> designs_of(const std::vector<std::string>& names, const RingLook& look = {}) {
  std::vector<Design> designs;
  for (const std::string& name : names) designs.push_back(design_of(name, look));
  return designs;
}

cv::Mat1b png_of(const std::string& name, double size_m, const RingLook& look = {}) {
  const auto pages = lay_out({design_of(name, look)}, {.size_m = size_m, .captions = false});
  return decoded(printed(pages, PrintFormat::png, kDpi).at(0));
}

double grey_at(const cv::Mat1b& picture, Vec2 p) {
  const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
  const double u = p.x - x, v = p.y - y;
  return (1 - v) * ((1 - u) * picture(y, x) + u * picture(y, x + 1)) +
         v * ((1 - u) * picture(y + 1, x) + u * picture(y + 1, x + 1));
}

/// Where the grey passes the middle between black and white along a ray, px from its start.
std::vector<double> edges_along(const cv::Mat1b& picture, Vec2 from, double angle, double length) {
  std::vector<double> edges;
  constexpr double kStep = 0.05;
  const Vec2 along{std::cos(angle), std::sin(angle)};
  double last = grey_at(picture, from);
  for (double at = kStep; at < length; at += kStep) {
    const double grey = grey_at(picture, from + at * along);
    if ((last < 127.5) != (grey < 127.5)) edges.push_back(at - kStep / 2);
    last = grey;
  }
  return edges;
}

/// The rings that a picture shows, from its middle out to just beyond them, in every of 24 directions.
void expect_rings(const cv::Mat1b& picture, Vec2 middle, double radius_px, const std::vector<Annulus>& rings,
                  double tolerance_px) {
  for (int direction = 0; direction < 24; ++direction) {
    const auto edges = edges_along(picture, middle, direction * std::numbers::pi / 12, 1.1 * radius_px);
    ASSERT_EQ(edges.size(), 2 * rings.size()) << direction;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      EXPECT_NEAR(edges[2 * i], rings[i].inner * radius_px, tolerance_px) << direction;
      EXPECT_NEAR(edges[2 * i + 1], rings[i].outer * radius_px, tolerance_px) << direction;
    }
  }
}

/// Pixel centres are at integers, and the page begins at -0.5.
Vec2 middle_px(const PlacedMarker& marker, double dots_per_mm) {
  const double half = marker.sheet_mm() / 2;
  return dots_per_mm * (marker.corner_mm + Vec2{half, half}) - Vec2{0.5, 0.5};
}

TEST(PrintedRings, HaveTheirRadiiInEveryDirection) {
  for (const char* name :
       {"ring:00", "ring:01", "ring:10", "ring:11", "ring(geometry=even):10", "ring:010110", "ring:1"})
    for (const bool inverted : {false, true}) {
      const RingLook look{.inverted = inverted};
      const auto pages = lay_out({design_of(name, look)}, {.size_m = 0.15});
      const PlacedMarker& placed = pages[0].markers[0];
      const cv::Mat1b picture = decoded(printed(pages, PrintFormat::png, kDpi).at(0));
      expect_rings(picture, middle_px(placed, kDotsPerMm), 75 * kDotsPerMm,
                   rings_of(std::get<RingMarker>(placed.design.form)), 0.2);
    }
}

TEST(PrintedRings, InvertedAreTheNegativeWithinTheQuietZone) {
  const RingLook hard{.soft_border = 0};
  const cv::Mat1b upright = png_of("ring:01", 0.08, hard);
  const cv::Mat1b inverted = png_of("ring:01", 0.08, {.soft_border = 0, .inverted = true});
  ASSERT_EQ(upright.size(), inverted.size());
  const double middle = (upright.cols - 1) / 2.0, radius = 1.28 * 40 * kDotsPerMm;
  double most = 0;
  for (int y = 0; y < upright.rows; ++y)
    for (int x = 0; x < upright.cols; ++x)
      if (std::hypot(x - middle, y - middle) < radius)
        most = std::max(most, std::abs(255.0 - upright(y, x) - inverted(y, x)));
  EXPECT_LE(most, 2);
}

TEST(PrintedRings, AreSeenBySimulatorAndPrinterAlike) {
  for (const char* name :
       {"ring:01", "ring(soft_border=0.3,inverted=false):011", "ring(inverted=true):10", "disc"}) {
    const PrintedTarget target = print_target(name, 0.15);
    // As many dots as the target's picture has pixels.
    const auto pages = lay_out({design_of(name)}, {.size_m = 0.15, .captions = false});
    const double dpi = target.picture.cols / pages[0].width_mm * 25.4;
    cv::Mat1b print = decoded(printed(pages, PrintFormat::png, dpi).at(0));
    ASSERT_EQ(print.size(), target.picture.size());
    cv::Mat1b difference;
    cv::absdiff(print, target.picture, difference);
    EXPECT_LT(cv::mean(difference)[0], 0.7) << name;  // edges: printers mix grey, the simulator light
    EXPECT_LT(cv::countNonZero(difference > 90), 1) << name;
  }
}

TEST(PrintedTargets, AreAsLargeAsTheySay) {
  const PrintedTarget ring = print_target("ring:01", 0.3);
  EXPECT_EQ(ring.outline, PrintedOutline::circle);
  EXPECT_EQ(ring.code, (Code{"ring2", "01"}));
  EXPECT_NEAR(ring.sheet_m, 0.3 * 1.34, 1e-12);
  const double half = (ring.picture.cols - 1) / 2.0;
  expect_rings(ring.picture, {half, half}, ring.picture.cols / 2.0 / 1.34,
               {{.18, .33}, {.41, .55}, {.855, 1}}, 0.4);  // half of the light is grey 188
  const PrintedTarget disc = print_target("disc", 0.3);
  EXPECT_EQ(disc.outline, PrintedOutline::circle);
  EXPECT_FALSE(disc.code);
  for (int direction = 0; direction < 24; ++direction) {
    const auto edges =
        edges_along(disc.picture, {half, half}, direction * std::numbers::pi / 12, 0.95 * half);
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_NEAR(edges[0], 0.3 / disc.sheet_m * disc.picture.cols / 2, 0.4);
  }
  const PrintedTarget square = print_target("aruco6x6_250:23", 0.3);
  EXPECT_EQ(square.outline, PrintedOutline::square);
  EXPECT_NEAR(square.sheet_m, 0.3 * 10 / 8, 1e-12);
  EXPECT_THROW(print_target("ring:01", 0), Error);
  EXPECT_THROW(print_target("rnig:01", 1), Error);
}

std::unique_ptr<Detector> reader_of(const std::string& family) {
  if (family.starts_with("aruco")) return aruco_detector({.dictionary = family.substr(5)});
  return apriltag_detector({.family = family.substr(5)});
}

/// Whether the code is read on the picture at this place, within a pixel, and as large as this.
void expect_read(const cv::Mat1b& picture, const Code& code, Vec2 centre, double side_px) {
  const Sightings found = reader_of(code.family)->detect(view(picture));
  const auto place =
      std::find_if(found.begin(), found.end(), [&](const Sighting& s) { return s.code == code; });
  ASSERT_NE(place, found.end()) << to_string(code);
  EXPECT_LT(norm(place->centre - centre), 1) << to_string(code);
  EXPECT_NEAR(size_of(place->outline), side_px, 2) << to_string(code);
}

const std::vector<std::string> kSquares{
    "aruco6x6_250:23", "aruco4x4_50:0",    "arucooriginal:7",         "apriltag36h11:5",     "apriltag25h9:0",
    "apriltag16h5:3",  "apriltag36h10:11", "apriltagStandard41h12:9", "apriltagCircle21h7:2"};

TEST(PrintedSquares, AreReadFromTheirTargetsByOurDetectors) {
  for (const std::string& name : kSquares) {
    const PrintedTarget target = print_target(name, 0.2);
    cv::Mat1b wall(target.picture.rows / 2 + 60, target.picture.cols / 2 + 60, std::uint8_t{128}), small;
    cv::resize(target.picture, small, {}, 0.5, 0.5, cv::INTER_AREA);
    small.copyTo(wall(cv::Rect(30, 30, small.cols, small.rows)));
    const double middle = 30 + (small.cols - 1) / 2.0;
    expect_read(wall, *target.code, {middle, middle}, target.size_m / target.sheet_m * small.cols);
  }
}

TEST(PrintedSquares, AreReadFromTheirSheetsByOurDetectors) {
  const auto pages = lay_out(designs_of(kSquares), {.size_m = 0.05, .paper = "a4"});
  const auto files = printed(pages, PrintFormat::png, kDpi);
  std::size_t read = 0;
  for (std::size_t i = 0; i < pages.size(); ++i)
    for (const PlacedMarker& placed : pages[i].markers) {
      expect_read(decoded(files[i]), *placed.design.code, middle_px(placed, kDotsPerMm), 50 * kDotsPerMm);
      ++read;
    }
  EXPECT_EQ(read, kSquares.size());
}

TEST(Sheets, KeepMarkersApartAndOnThePaperInTheirOrder) {
  std::vector<std::string> names = kSquares;
  for (const char* name : {"ring:01", "ring:1", "ring(soft_border=0.5):111", "disc"})
    names.emplace_back(name);
  for (const double size_m : {0.01, 0.03, 0.05, 0.08}) {
    const auto pages = lay_out(designs_of(names), {.size_m = size_m, .paper = "letter"});
    std::vector<std::string> order;
    for (const Page& page : pages)
      for (std::size_t i = 0; i < page.markers.size(); ++i) {
        const auto box = [&](std::size_t k) {
          const PlacedMarker& m = page.markers[k];
          const double caption_mm = kCaptionLineMm * static_cast<double>(m.caption.size());
          return Box{m.corner_mm.x, m.corner_mm.y, m.sheet_mm(), m.sheet_mm() + caption_mm};
        };
        order.push_back(page.markers[i].design.name);
        EXPECT_NEAR(intersect(box(i), Box{4, 4, 207.9, 271.4}).area(), box(i).area(), 1e-6);
        for (std::size_t k = 0; k < i; ++k) EXPECT_EQ(intersect(box(i), box(k)).area(), 0);
      }
    EXPECT_EQ(order, names);
  }
}

TEST(Sheets, AreTheSameBytesEveryTime) {
  const auto pages =
      lay_out(designs_of({"ring:01", "aruco6x6_250:23", "ring:10"}), {.size_m = 0.1, .paper = "a4"});
  for (const PrintFormat format : {PrintFormat::pdf, PrintFormat::png}) {
    const auto files = printed(pages, format, 100);
    EXPECT_EQ(printed(pages, format, 100), files);
    EXPECT_EQ(files.size(), format == PrintFormat::pdf ? 1u : pages.size());
    for (const std::string& file : files) EXPECT_EQ(file.find("CreationDate"), std::string::npos);
  }
}

TEST(Sheets, OfPngSayHowLargeADotIs) {
  const auto pages = lay_out({design_of("ring:01")}, {.size_m = 0.05});
  const std::string file = printed(pages, PrintFormat::png, 254).at(0);
  const std::size_t chunk = file.find("pHYs");
  ASSERT_NE(chunk, std::string::npos);
  EXPECT_EQ(file.substr(chunk + 4, 9), std::string("\0\0\x27\x10\0\0\x27\x10\1", 9));  // 10000 a metre
}

TEST(Sheets, RefuseWhatTheyCannotShow) {
  const auto pages = lay_out({design_of("ring:010110")}, {.size_m = 0.01});
  EXPECT_THROW(printed(pages, PrintFormat::png, 100), Error);  // rings of 1.2 dots
  EXPECT_NO_THROW(printed(pages, PrintFormat::png, 200));
  EXPECT_THROW(printed(pages, PrintFormat::png, 5000), Error);
  EXPECT_THROW(printed(lay_out({design_of("disc")}, {.size_m = 2}), PrintFormat::png, 600), Error);
  EXPECT_THROW(lay_out({design_of("ring:01")}, {.size_m = 0.16, .paper = "a4"}), Error);
  EXPECT_NO_THROW(lay_out({design_of("ring:01")}, {.size_m = 0.15, .paper = "a4"}));
  EXPECT_THROW(lay_out({design_of("ring:01")}, {.paper = "a5"}), Error);
}

/// The PDF's first page as poppler shows it.
TEST(Sheets, OfPdfHaveTheRingsAtTheirTrueSizeForAnotherPrograms) {
  if (std::system("command -v pdftoppm >/dev/null") != 0) GTEST_SKIP() << "there is no pdftoppm";
  const std::string place = testing::TempDir() + "relock_printed_marker";
  const auto pages = lay_out(designs_of({"ring:01"}), {.size_m = 0.15, .paper = "a4"});
  std::ofstream(place + ".pdf", std::ios::binary) << printed(pages, PrintFormat::pdf, 300).at(0);
  const std::string command = "pdftoppm -r 150 -gray -png -singlefile " + place + ".pdf " + place;
  ASSERT_EQ(std::system(command.c_str()), 0);
  const cv::Mat1b picture = cv::imread(place + ".png", cv::IMREAD_GRAYSCALE);
  EXPECT_NEAR(picture.cols, 210 * kDotsPerMm, 1);
  EXPECT_NEAR(picture.rows, 297 * kDotsPerMm, 1);
  const PlacedMarker& placed = pages[0].markers[0];
  const double half_a_percent = 0.005 * 75 * kDotsPerMm;
  expect_rings(picture, middle_px(placed, kDotsPerMm), 75 * kDotsPerMm,
               rings_of(std::get<RingMarker>(placed.design.form)), half_a_percent / 2);
  std::remove((place + ".pdf").c_str());
  std::remove((place + ".png").c_str());
}

}  // namespace
}  // namespace relock
