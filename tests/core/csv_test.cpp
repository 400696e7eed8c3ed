#include "core/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/error.h"
#include "core/outline_csv.h"
#include "core/random.h"
#include "tests/fault.h"

namespace relock {
namespace {

/// The error that reading `text` and asking every cell for a number ends in; empty if there is none.
std::string fault_of_csv(const std::string& text) {
  return fault_of([&] {
    std::istringstream in(text);
    CsvReader rows(in, "file.csv");
    while (rows.next())
      for (std::size_t i = 0; i < rows.header().size(); ++i) rows.number(i);
  });
}

TEST(CsvReader, NamesFileLineAndColumnOfABadNumber) {
  EXPECT_EQ(fault_of_csv("a,b\n1,2\n3,x\n"), "file.csv:3: column b: \"x\" is no finite number");
  EXPECT_EQ(fault_of_csv("a,b\n1,nan\n"), "file.csv:2: column b: \"nan\" is no finite number");
  EXPECT_EQ(fault_of_csv("a,b\n1\n"), "file.csv:2: this line has 1 cells and the header has 2");
  EXPECT_EQ(fault_of_csv("a,a\n"), "file.csv:1: two columns are called \"a\"");
  EXPECT_EQ(fault_of_csv(""), "file.csv: the file is empty; it needs a header line");
}

TEST(CsvReader, TakesQuotesWindowsLineEndsEmptyLinesAndAByteOrderMark) {
  std::istringstream in("\xEF\xBB\xBFname,x\r\n\"a, \"\"b\"\"\",1\r\n\r\nc,2\r\n");
  CsvReader rows(in, "file.csv");
  const auto name = rows.column("name"), x = rows.column("x");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.text(name), "a, \"b\"");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.number(x), 2);
  EXPECT_EQ(rows.line(), 4u);
  EXPECT_FALSE(rows.next());
}

TEST(CsvReader, OffersTheNearestColumn) {
  std::istringstream in("frmae\n");
  const CsvReader rows(in, "labels.csv");
  const std::vector<std::string> known{"frame", "target"};
  try {
    rows.expect_only(known);
    FAIL();
  } catch (const Error& fault) {
    EXPECT_STREQ(fault.what(), "labels.csv:1: no column is called \"frmae\" (did you mean \"frame\"?)");
  }
}

TEST(CsvReader, EndsInAnErrorOrNotAtAllOnAnyBytes) {
  Random random(11);
  const std::string alphabet = "0123456789.,,,\n\n\"\r-eax\xFF";
  for (int i = 0; i < 20000; ++i) {
    std::string text = "a,b,c\n";
    for (auto n = random.below(40); n > 0; --n) text += alphabet[random.below(alphabet.size())];
    fault_of_csv(text);  // throws nothing but Error
  }
}

TEST(OutlineCsv, GivesBackWhatWasWritten) {
  const std::vector<std::optional<Outline>> outlines{
      Outline(Box{1.25, -2.5, 30, 40.0625}), Outline(Quad{{Vec2{0, 0}, {10, 1}, {11, 12}, {-1, 9.5}}}),
      Outline(Ellipse{{3, 4}, 10, 2.5, 0.75}), std::nullopt};
  std::string text = "n";
  for (const std::string& name : outline_columns()) text += "," + name;
  text += "\n";
  for (const auto& outline : outlines) {
    text += "0";
    append_outline(text, outline, 4);
    text += "\n";
  }
  std::istringstream in(text);
  CsvReader rows(in, "file.csv");
  const OutlineColumns columns(rows);
  for (const auto& outline : outlines) {
    ASSERT_TRUE(rows.next());
    EXPECT_EQ(columns.read(rows), outline);
  }
}

TEST(OutlineCsv, SaysWhichColumnOfASetIsMissing) {
  std::istringstream in("x,y,width\n");
  const CsvReader rows(in, "labels.csv");
  try {
    OutlineColumns columns(rows);
    FAIL();
  } catch (const Error& fault) {
    EXPECT_STREQ(fault.what(), "labels.csv:1: the column \"height\" is missing");
  }
}

}  // namespace
}  // namespace relock
