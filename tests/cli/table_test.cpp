#include "cli/table.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string_view>

#include "made_comparison.h"

namespace relock {
namespace {

Table awkward() {
  Table table({"method", "% D", "a_b "});
  table.add({"csrt(psr_threshold=0.05)", "<1.40", "0.9 [.8,.9]*"});
  table.add({"net(a|b,^~$#&{}`\\)", ">2", " "});
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// How often `c` stands there without a backslash before it.
std::size_t bare(std::string_view text, char c) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\')
      ++i;
    else if (text[i] == c)
      ++count;
  }
  return count;
}

TEST(TextTables, LineTheirColumnsUp) {
  EXPECT_EQ(Table({"method", "losses"}).text(2), "  method  losses\n");
  Table table({"method", "losses"});
  table.add({"kcf", "12"});
  table.add({"aruco_6x6", "3"});
  EXPECT_EQ(table.text(1), " method     losses\n kcf            12\n aruco_6x6       3\n");
  EXPECT_EQ(table.in(TableFormat::text), table.text(2));
}

TEST(MarkdownTables, HaveAsManyCellsInEveryRowWhateverMethodsAreCalled) {
  const auto lines = lines_of(awkward().in(TableFormat::markdown));
  ASSERT_EQ(lines.size(), 4u);
  for (const std::string& line : lines) EXPECT_EQ(bare(line, '|'), 4u) << line;
  EXPECT_EQ(lines[1], "|---|---:|---:|");
}

TEST(MarkdownTables, EscapeWhatMarkdownWouldRead) {
  const std::string text = awkward().in(TableFormat::markdown);
  for (const char c : {'_', '*', '<', '`'}) EXPECT_EQ(bare(text, c), 0u) << c << " in\n" << text;
  EXPECT_NE(text.find("| csrt(psr\\_threshold=0.05) | \\<1.40 | 0.9 [.8,.9]\\* |"), std::string::npos)
      << text;
}

TEST(LatexTables, HaveAsManyCellsInEveryRowWhateverMethodsAreCalled) {
  std::size_t rows = 0;
  for (const std::string& line : lines_of(awkward().in(TableFormat::latex))) {
    if (!line.ends_with("\\\\")) continue;
    EXPECT_EQ(bare(line, '&'), 2u) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 3u);
}

TEST(LatexTables, EscapeWhatLatexWouldRead) {
  const std::string text = awkward().in(TableFormat::latex);
  for (const char c : {'_', '%', '#', '^', '~'}) EXPECT_EQ(bare(text, c), 0u) << c << " in\n" << text;
  EXPECT_NE(text.find("net(a$|$b"), std::string::npos) << text;  // else a dash
  EXPECT_NE(text.find("csrt(psr\\_threshold=0.05) & $<$1.40 & "), std::string::npos) << text;
  EXPECT_NE(text.find("\\$\\#\\&\\{\\}"), std::string::npos) << text;
  EXPECT_EQ(bare(text, '{') - bare(text, '}'), 0u);
  EXPECT_EQ(bare(text, '$') % 2, 0u);
}

TEST(LatexTables, AreOneTabularWithBooktabs) {
  const std::string text = awkward().in(TableFormat::latex);
  EXPECT_TRUE(text.starts_with("\\begin{tabular}{lrr}\n\\toprule\n")) << text;
  EXPECT_TRUE(text.ends_with("\\bottomrule\n\\end{tabular}\n")) << text;
}

TEST(ScoreTables, HaveARowForEachMethodInEveryFormat) {
  const std::string letters = "HHHHHMHHHHHHMMMMMMHHHHHSSSHHHHHH";
  const MadeConditions slow{.real_time = "latest", .latency = "constant(20ms)"};
  const JudgedTable judged =
      judged_tables(
          {made_comparison("a", {{"csrt(psr_threshold=0.05)", {letters}}, {"mute", {letters}, true}}, slow)})
          .at(0);
  for (const Table& table : {keeping_table(judged), exactness_table(judged), real_time_table(judged.table),
                             bins_table({&judged})}) {
    EXPECT_EQ(lines_of(table.in(TableFormat::text)).size(), 3u);
    const auto markdown = lines_of(table.in(TableFormat::markdown));
    ASSERT_EQ(markdown.size(), 4u);
    for (const std::string& line : markdown) EXPECT_EQ(bare(line, '|'), bare(markdown[0], '|')) << line;
    std::vector<std::size_t> cells;
    for (const std::string& line : lines_of(table.in(TableFormat::latex)))
      if (line.ends_with("\\\\")) cells.push_back(bare(line, '&'));
    EXPECT_EQ(cells, std::vector<std::size_t>(3, cells.at(0)));
  }
}

TEST(Headings, SayUnderWhatConditions) {
  const std::string letters(12, 'H');
  const MadeConditions conditions{.gaps = "paper", .seed = 7, .protocol = Protocol::reset};
  EXPECT_EQ(heading(judged_tables({made_comparison("a", {{"mine", {letters}}}, conditions)}).at(0).table),
            "a, gaps paper (seed 7), protocol reset, gate centre 0.25 D, hold 0.5 D");
  EXPECT_EQ(heading(judged_tables({made_comparison("a", {{"mine", {letters}}}),
                                   made_comparison("b", {{"mine", {letters}}})})
                        .at(0)
                        .table),
            "2 recordings, as recorded, protocol once, gate centre 0.25 D, hold 0.5 D");
}

}  // namespace
}  // namespace relock
