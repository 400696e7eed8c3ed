#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "cli/report/encoded.h"
#include "cli/report/page.h"
#include "cli/report/provenance.h"
#include "cli/report/timelines.h"

namespace relock::reports {
namespace {

std::string base64_of(const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  return base64(bytes);
}

TEST(ReportData, IsBase64AsRfc4648HasIt) {
  const std::map<std::string, std::string> vectors{{"", ""},
                                                   {"f", "Zg=="},
                                                   {"fo", "Zm8="},
                                                   {"foo", "Zm9v"},
                                                   {"foob", "Zm9vYg=="},
                                                   {"fooba", "Zm9vYmE="},
                                                   {"foobar", "Zm9vYmFy"}};
  for (const auto& [text, code] : vectors) EXPECT_EQ(base64_of(text), code);
}

TEST(ReportData, PacksNumbersInStepsAndTellsWhatIsMissingFromWhatIsLarge) {
  EXPECT_EQ(packed({0.0}), base64_of(std::string("\0\0", 2)));
  EXPECT_EQ(packed({256 * kPackedStep}), base64_of(std::string("\0\1", 2)));
  EXPECT_EQ(packed({std::nullopt}), base64_of("\xff\xff"));
  EXPECT_EQ(packed({std::numeric_limits<double>::infinity()}), packed({std::nullopt}));
  EXPECT_EQ(packed({1e9}), base64_of("\xfe\xff"));
}

TEST(ReportData, CountsLettersThatStayTheSame) {
  EXPECT_EQ(run_lengths(""), "");
  EXPECT_EQ(run_lengths("gHHH..M"), "g1H3.2M1");
}

Json named(const std::string& name) {
  return {{"title", name}, {"tables", Json::array({{{"heading", name}, {"words", {name}}}})}};
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(ReportPage, HasAsManyTagsWhateverNamesHold) {
  const std::string plain = page(named("plain")),
                    hostile = page(named("</script><script>alert(1)</script><!--"));
  for (const char* tag : {"<script", "</script", "<!--"})
    EXPECT_EQ(count(hostile, tag), count(plain, tag)) << tag;
}

TEST(ReportPage, KeepsItsDataAsTheyAre) {
  const Json data = named("a <b> & \"c\" \xc3\xa4");
  const std::string text = page(data), begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = text.find(begin) + begin.size();
  EXPECT_EQ(Json::parse(text.substr(at, text.find("</script>", at) - at)), data);
}

TEST(ReportPage, AsksForNothing) {
  const std::string text = page(named("plain"));
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
  for (const char* asking : {"<link", "src=\"", "@import", "url(", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(text.find(asking), std::string::npos) << asking;
}

TEST(ReportPage, CarriesTheNoticeOfWhatItIsMadeOf) {
  EXPECT_NE(page(named("plain")).find("Copyright (c) 2022 Leon Sorokin"), std::string::npos);
}

TEST(ReportCommands, QuoteWhatAShellWouldTakeApart) {
  EXPECT_EQ(shell_word("kcf"), "kcf");
  EXPECT_EQ(shell_word("trace(a b.csv)"), "'trace(a b.csv)'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

/// Two methods and a yardstick that each say one place, or none.
StoredComparison saying(const std::vector<std::optional<Vec2>>& places) {
  StoredComparison comparison;
  comparison.recording.targets = {{"target"}};
  comparison.recording.captured = {Time{}};
  comparison.recording.truth.resize(1);
  for (const auto& place : places) {
    StoredRun run;
    run.trajectory.frames.resize(1);
    if (place) run.trajectory.frames[0].sightings = {sighting_of(Box{place->x, place->y, 40, 40})};
    comparison.runs.push_back(run);
  }
  return comparison;
}

TEST(ReportAgreement, IsTheShareOfPairsAtOnePlace) {
  EXPECT_EQ(agreement(saying({Vec2{0, 0}, Vec2{19, 0}}), 0).front(), 1);
  EXPECT_EQ(agreement(saying({Vec2{0, 0}, Vec2{21, 0}}), 0).front(), 0);
  EXPECT_NEAR(*agreement(saying({Vec2{0, 0}, Vec2{1, 0}, Vec2{99, 0}}), 0).front(), 1 / 3., 1e-12);
}

TEST(ReportAgreement, TakesTwoWhoSayAPlace) {
  EXPECT_FALSE(agreement(saying({Vec2{0, 0}, std::nullopt}), 0).front());
  StoredComparison with_yardstick = saying({Vec2{0, 0}, Vec2{0, 0}});
  with_yardstick.runs[1].record.yardstick = true;
  EXPECT_FALSE(agreement(with_yardstick, 0).front());
}

}  // namespace
}  // namespace relock::reports
