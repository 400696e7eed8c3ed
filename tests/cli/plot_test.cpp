// What plots show, read from the SVG and the bytes that are drawn.
#include "cli/plot/plot.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>

#include "cli/files.h"
#include "core/error.h"
#include "tests/fault.h"

namespace relock {
namespace {

namespace fs = std::filesystem;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kFirstColour = "rgb(  0, 114, 178)", kSecondColour = "rgb(213,  94,   0)",
                           kGrey = "rgb(128, 128, 128)";

class Plots : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  template <class Figure>
  std::string drawn(const Figure& plot, const std::string& ending = ".svg") const {
    draw(plot, folder_ / ("plot" + ending));
    return read_file(folder_ / ("plot" + ending));
  }

  const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("relock-plots-{}-{}", getpid(),
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
};

Plot one_curve(PlotCurve curve) {
  return {.title = "t", .x = {"x"}, .y = {"y"}, .curves = {std::move(curve)}};
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The paths of an SVG that are drawn in one colour, one after the other.
std::string paths_in(const std::string& svg, std::string_view colour) {
  const std::regex path(fmt::format("<path stroke='{}'[^>]*>",
                                    std::regex_replace(std::string(colour), std::regex("[()]"), "\\$&")));
  std::string all;
  for (std::sregex_iterator it(svg.begin(), svg.end(), path), end; it != end; ++it) all += it->str() + "\n";
  return all;
}

LanePlot lanes(std::size_t count_of_lanes, std::size_t stretches) {
  LanePlot plot{.title = "t", .x = {"time [s]"}, .kinds = {"seen", "elsewhere"}};
  for (std::size_t i = 0; i < count_of_lanes; ++i) {
    plot.lanes.push_back({fmt::format("lane {}", i), {}});
    for (std::size_t k = 0; k < stretches; ++k)
      plot.lanes.back().stretches.push_back({static_cast<double>(k), static_cast<double>(k) + .5, 0});
  }
  return plot;
}

TEST_F(Plots, AreTheSameBytesWhenDrawnAgain) {
  const Plot plot = one_curve({"a", {{1, 2, Interval{1, 3}}, {2, 5}, {3, kNothing}, {4, 4}}});
  for (const char* ending : {".svg", ".pdf", ".png"}) {
    const std::string first = drawn(plot, ending);
    setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
    EXPECT_EQ(first, drawn(plot, ending)) << ending;
    unsetenv("SOURCE_DATE_EPOCH");
    EXPECT_EQ(drawn(lanes(3, 5), ending), drawn(lanes(3, 5), ending)) << ending;
  }
}

TEST_F(Plots, AreWhatTheirEndingSays) {
  const Plot plot = one_curve({"a", {{1, 2}, {2, 5}}});
  EXPECT_TRUE(drawn(plot, ".png").starts_with("\x89PNG"));
  const std::string pdf = drawn(plot, ".pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF"));
  EXPECT_NE(pdf.find("/FontFile"), std::string::npos) << "its fonts are embedded";
  EXPECT_NE(drawn(plot).find("width=\"120mm\" height=\"80mm\""), std::string::npos);
  EXPECT_EQ(fault_of([&] { draw(plot, folder_ / "plot.gif"); }),
            (folder_ / "plot.gif").string() + " cannot be drawn; a plot's name ends in .svg, .pdf or .png");
}

TEST_F(Plots, NameEveryCurveThatHasAName) {
  Plot plot{.title = "all of them", .x = {"blur [px]"}, .y = {"recognised [%]"}};
  for (int i = 0; i < 20; ++i)
    plot.curves.push_back(
        {fmt::format("curve number {}!", i), {{0, 1. * i}, {1, i + 1.}}, CurveStyle::line, i > 15});
  plot.curves.push_back({"it has no points", {}});
  plot.curves.push_back({"", {{0, 0}, {1, 7}}});
  const std::string svg = drawn(plot);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(count(svg, fmt::format(">curve number {}!<", i)), 1u) << i;
  for (const char* text : {"it has no points", "all of them", "blur [px]", "recognised [%]"})
    EXPECT_EQ(count(svg, fmt::format(">{}<", text)), 1u) << text;
}

TEST_F(Plots, HaveRoomForEveryNameInTheLegend) {
  for (const std::size_t length : {1, 10, 30, 60})
    for (const std::size_t names : {3, 7, 20}) {
      Plot plot = one_curve({"", {{1, 1}, {2, 2}}});
      LanePlot rows = lanes(1, 1);
      for (std::size_t i = rows.kinds.size(); i < names; ++i) {
        const std::string name = fmt::format("{}{}", std::string(length, 'm'), i);
        plot.curves.push_back({name, {{1, 1}}});
        rows.kinds.push_back(name);
      }
      const std::string both = drawn(plot) + drawn(rows);
      for (std::size_t i = 2; i < names; ++i)
        EXPECT_EQ(count(both, ">" + rows.kinds[i] + "<"), 2u) << names << " names, " << rows.kinds[i];
    }
}

TEST_F(Plots, ShowTextsAsTheyAreWhateverIsInThem) {
  const fs::path touched = folder_ / "touched";
  const std::string text =
      fmt::format("it's \"100 %g\" _a^b{{c}} \\n & <script>x</script> `touch {}` \\", touched.string());
  const std::string in_svg =
      std::regex_replace(std::regex_replace(text, std::regex("&"), "&amp;"), std::regex("<"), "&lt;");
  const std::string svg = drawn(
      Plot{.title = "", .x = {text}, .y = {"y"}, .curves = {{text, {{1, 1}, {2, 2}}}}, .width_mm = 900});
  EXPECT_EQ(count(svg, in_svg), 2u) << svg;
  LanePlot rows = lanes(1, 1);
  rows.title = rows.kinds[0] = text;
  rows.lanes[0].name = "100 %g \\ ' <b> `touch me`";
  rows.width_mm = 900;
  const std::string lanes_svg = drawn(rows);
  EXPECT_EQ(count(lanes_svg, in_svg), 2u);
  EXPECT_EQ(count(lanes_svg, ">100 %g \\ ' &lt;b> `touch me`<"), 1u);
  EXPECT_FALSE(fs::exists(touched));
}

TEST_F(Plots, PutATextWithLineBreaksAndBytesThatAreNoTextOnOneLine) {
  const std::string svg = drawn(one_curve({"one\ntwo\t\x01three\xff\xc3", {{1, 1}, {2, 2}}}));
  EXPECT_EQ(count(svg, ">one two  three\xef\xbf\xbd\xef\xbf\xbd<"), 1u);
}

TEST_F(Plots, BreakALineWhereAPointIsNotFinite) {
  const auto lines = [&](double third) {
    PlotCurve curve{"", {{1, 1}, {2, 3}, {3, third}, {4, 1}, {5, 2}}, CurveStyle::line};
    return count(paths_in(drawn(one_curve(curve)), kFirstColour), "M");
  };
  EXPECT_EQ(lines(2), 1u);
  EXPECT_EQ(lines(kNothing), 2u);
  EXPECT_EQ(lines(std::numeric_limits<double>::infinity()), 2u);
}

TEST_F(Plots, ShowAPointThatALineWouldNotShow) {
  const std::string svg = drawn(one_curve({"", {{1, 1}, {2, 3}, {3, kNothing}, {4, 1}}, CurveStyle::line}));
  EXPECT_EQ(count(svg, "<use xlink:href='#gpPt6'"), 1u);
}

TEST_F(Plots, DrawIntervalsAsWhiskersUnlessTheyHaveNoEnd) {
  const auto paths = [&](std::optional<Interval> interval) {
    PlotCurve curve{"", {{1, 1}, {2, 3, interval}}, CurveStyle::points};
    return count(paths_in(drawn(one_curve(curve)), kFirstColour), "M");
  };
  EXPECT_GT(paths(Interval{2, 4}), paths(std::nullopt));
  EXPECT_EQ(paths(Interval{0, std::numeric_limits<double>::infinity()}), paths(std::nullopt));
}

TEST_F(Plots, DrawPublishedFiguresGreyAndDashed) {
  const std::string svg = drawn(one_curve({"the paper", {{1, 1}, {2, 2}}, CurveStyle::line, true}));
  EXPECT_NE(paths_in(svg, kGrey).find("stroke-dasharray"), std::string::npos);
  EXPECT_EQ(paths_in(svg, kFirstColour), "");
}

TEST_F(Plots, TellCurvesApartWithoutTheirColours) {
  Plot plot{.x = {"x"}, .y = {"y"}};
  for (int i = 0; i < 2; ++i) plot.curves.push_back({"", {{0, 1. * i}, {1, i + 1.}}});
  const std::string svg = drawn(plot);
  EXPECT_EQ(count(paths_in(svg, kFirstColour), "stroke-dasharray"), 0u);
  EXPECT_EQ(count(paths_in(svg, kSecondColour), "stroke-dasharray"), 1u);
  EXPECT_EQ(count(svg, "<use xlink:href='#gpPt4'"), 2u) << "the second one's squares";
}

TEST_F(Plots, OfNothingOrOfOnePointAreSensible) {
  EXPECT_EQ(count(drawn(Plot{}), ">no data<"), 1u);
  EXPECT_EQ(count(drawn(one_curve({"a", {{1, kNothing}}})), ">no data<"), 1u);
  EXPECT_EQ(count(drawn(one_curve({"a", {{5, 3}}})), ">5<"), 1u) << "its place is on the axis";
  EXPECT_EQ(count(drawn(one_curve({"a", {{0, 0}, {0, 0}}})), ">0<"), 2u);
  Plot logarithmic = one_curve({"a", {{0, 1}, {10, 100, Interval{0, 1000}}}});
  logarithmic.x.logarithmic = logarithmic.y.logarithmic = true;
  EXPECT_EQ(count(drawn(logarithmic), ">1000<"), 1u);
  EXPECT_NE(drawn(LanePlot{}), "");
}

TEST_F(Plots, KeepTheEndsThatAnAxisStates) {
  Plot plot = one_curve({"a", {{1, 1}, {2, 2}}});
  plot.y.low = -40, plot.y.high = 40;
  const std::string svg = drawn(plot);
  EXPECT_EQ(count(svg, ">-40<") + count(svg, ">40<"), 2u);
  plot.y = {"speed", 3, 2};
  EXPECT_EQ(fault_of([&] { drawn(plot); }), "the axis \"speed\" of a plot cannot go from 3 to 2");
  plot.y = {"speed", 0, 2, true};
  EXPECT_EQ(fault_of([&] { drawn(plot); }),
            "the axis \"speed\" of a plot is logarithmic and cannot go from 0 to 2");
  plot.y = {"speed", 9, {}};
  EXPECT_NE(drawn(plot), "") << "all data are beyond it";
}

TEST_F(Plots, HaveALaneForEachNameAndABoxForEachStretch) {
  const std::string svg = drawn(lanes(4, 100));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(count(svg, fmt::format(">lane {}<", i)), 1u);
  EXPECT_EQ(count(svg, "<polygon"), 400u);
  EXPECT_EQ(count(svg, ">seen<") + count(svg, ">elsewhere<"), 2u);
}

TEST_F(Plots, JoinStretchesThatTouchAndKeepTheShortest) {
  LanePlot plot = lanes(1, 0);
  plot.lanes[0].stretches = {{0, 1, 0}, {1, 2, 0}, {3, 4, 0}, {4, 4, 1}, {4, kNothing, 0}};
  EXPECT_EQ(count(drawn(plot), "<polygon"), 3u);
  plot.lanes[0].stretches.push_back({0, 1, 2});
  EXPECT_EQ(fault_of([&] { drawn(plot); }),
            "a stretch of \"lane 0\" is of kind 2, and the plot names 2 kinds");
}

TEST_F(Plots, OfLanesAreAsLargeAsAsked) {
  LanePlot plot = lanes(4, 3);
  plot.width_mm = 85, plot.height_mm = 60;
  EXPECT_NE(drawn(plot).find("width=\"85mm\" height=\"60mm\""), std::string::npos);
  plot.above = {{0, 1, 3}, {1, 2, 7}};
  plot.above_title = "blur [px]";
  EXPECT_NE(drawn(plot).find("width=\"85mm\" height=\"60mm\""), std::string::npos);
  plot.height_mm = 20;
  EXPECT_NE(fault_of([&] { drawn(plot); }).find("4 lanes and their legend need a figure of"),
            std::string::npos);
}

TEST_F(Plots, HaveBarsOverTheLanesOnTheSameAxis) {
  LanePlot plot = lanes(2, 3);
  const std::string without = drawn(plot);
  plot.above = {{0, .5, 3}, {1, 2, 7}, {2, 2.5, kNothing}};
  plot.above_title = "blur [px]";
  const std::string svg = drawn(plot);
  EXPECT_EQ(count(svg, "<polygon"), count(without, "<polygon") + 2);
  for (const char* text : {"blur [px]", "time [s]", "lane 0", "seen"})
    EXPECT_EQ(count(svg, fmt::format(">{}<", text)), 1u) << text;
}

TEST_F(Plots, HaveLanesThatLookAsStated) {
  LanePlot plot = lanes(1, 3);
  plot.looks = {{"#123456", -.4, .4}, {"#654321", -.4, 0}};
  EXPECT_NE(drawn(plot).find("rgb( 18,  52,  86)"), std::string::npos);
  plot.looks.pop_back();
  EXPECT_EQ(fault_of([&] { drawn(plot); }), "a plot names 2 kinds and 1 looks of them");
}

TEST_F(Plots, ThatCannotBeWrittenSaySoAndLeaveNothing) {
  const Plot plot = one_curve({"a", {{1, 1}, {2, 2}}});
  EXPECT_NE(
      fault_of([&] { draw(plot, folder_ / "nowhere" / "plot.svg"); }).find("plot.svg cannot be written"),
      std::string::npos);
  fs::create_directories(folder_ / "taken.svg" / "full");
  EXPECT_NE(fault_of([&] { draw(plot, folder_ / "taken.svg"); }).find("cannot be written"),
            std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Plots, NeedGnuplot) {
  EXPECT_TRUE(can_plot());
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  EXPECT_FALSE(can_plot());
  EXPECT_EQ(fault_of([&] {
              drawn(one_curve({"a", {{1, 1}}}));
            }),
            "gnuplot is not installed, and plots are drawn by it; install the package gnuplot-nox");
  const fs::path fake = folder_ / "gnuplot";
  write_file(fake, "#!/bin/sh\necho first >&2\necho '   it is broken ' >&2\nexit 3\n");
  fs::permissions(fake, fs::perms::owner_all);
  setenv("PATH", (folder_.string() + ":/bin:/usr/bin").c_str(), 1);
  EXPECT_EQ(fault_of([&] { drawn(one_curve({"a", {{1, 1}}})); }), "gnuplot draws no plot: it is broken");
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace relock
