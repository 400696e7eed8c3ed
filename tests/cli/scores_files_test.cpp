#include "cli/scores/files.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/csv.h"
#include "made_comparison.h"

namespace relock {
namespace {

const std::string kLetters = "HHHHHMHHHHHHMMMMMMHHHHHSSSHHHHHH";
const std::string kSpoken = "csrt(psr_threshold=0.05)", kQuoted = "net(model=\"a, b\")";

std::vector<JudgedTable> some_tables(Grouping grouping = Grouping::none) {
  const std::vector<MadeRun> runs{{kSpoken, {kLetters, kLetters}},
                                  {kQuoted, {kLetters, std::string(kLetters.size(), 'M')}},
                                  {"mute", {std::string(kLetters.size(), 'M'), kLetters}, true}};
  const MadeConditions slow{.real_time = "latest", .latency = "constant(20ms)"};
  return judged_tables({made_comparison("a", runs), made_comparison("a", runs, slow)}, grouping);
}

/// Rows of a table by what they are about: everything but value, low, high and standing.
std::map<std::vector<std::string>, std::string> values_in(const std::string& text) {
  std::istringstream in(text);
  CsvReader rows(in, "scores.csv");
  std::map<std::vector<std::string>, std::string> values;
  while (rows.next()) {
    std::vector<std::string> key;
    for (const char* name :
         {"protocol", "gaps", "gate", "real_time", "latency", "by", "group", "method", "score"})
      key.emplace_back(rows.text(rows.column(name)));
    EXPECT_TRUE(values.emplace(key, rows.text(rows.column("value"))).second)
        << "line " << rows.line() << " is about the same as one before";
  }
  return values;
}

TEST(ScoresCsv, HasOneRowForEachScoreOfEachMethod) {
  const auto tables = some_tables();
  ASSERT_EQ(tables.size(), 2u);
  std::map<std::string, std::set<std::string>> scores;
  std::size_t rows = 0;
  for (const auto& [key, value] : values_in(tables_csv(tables))) {
    scores[key[3] + key[7]].insert(key[8]);
    ++rows;
  }
  ASSERT_EQ(scores.size(), 6u);  // two tables of three methods
  const auto& first = scores.begin()->second;
  EXPECT_EQ(rows, 6 * first.size());
  for (const auto& [method, of_it] : scores) EXPECT_EQ(of_it, first) << method;
  for (const ShareScore& score : share_scores()) EXPECT_TRUE(first.contains(std::string(score.name)));
}

TEST(ScoresCsv, ReadsBackAsTheScores) {
  const auto tables = some_tables();
  const auto values = values_in(tables_csv(tables));
  for (const JudgedTable& judged : tables)
    for (std::size_t i = 0; i < judged.methods.size(); ++i)
      for (const ShareScore& score : share_scores()) {
        const TableConditions& c = judged.table.conditions;
        const std::string& read = values.at({c.protocol, c.gaps, c.gate, c.real_time, c.latency, "", "",
                                             judged.table.methods[i].method, std::string(score.name)});
        const auto& value = judged.methods[i].scores.*score.value;
        ASSERT_EQ(value.has_value(), !read.empty()) << score.name;
        if (value) {
          EXPECT_NEAR(std::stod(read), *value, 1e-6) << score.name;
        }
      }
}

TEST(ScoresCsv, HasOnlyRecognitionOfBins) {
  for (const Grouping grouping : {Grouping::blur, Grouping::gap})
    for (const auto& [key, value] : values_in(tables_csv(some_tables(grouping)))) {
      EXPECT_EQ(key[5], to_string(grouping));
      EXPECT_FALSE(key[6].empty());
      EXPECT_EQ(key[8], "recognition");
    }
}

TEST(ScoresJson, HasNullWhereThereIsNoScore) {
  const auto tables = some_tables();
  const auto json = nlohmann::json::parse(tables_json(tables)).at("tables");
  ASSERT_EQ(json.size(), tables.size());
  EXPECT_EQ(json[0].at("real_time"), "");
  EXPECT_EQ(json[1].at("real_time"), "latest");
  const auto& mine = json[0].at("methods").at(0);
  EXPECT_EQ(mine.at("method"), kSpoken);
  EXPECT_DOUBLE_EQ(mine.at("scores").at("recognition"), *tables[0].methods[0].scores.recognition);
  EXPECT_TRUE(mine.at("scores").at("false_alarms_per_1000").is_null());  // the targets are always there
  EXPECT_TRUE(mine.at("real_time").is_null());
  EXPECT_FALSE(json[1].at("methods").at(0).at("real_time").is_null());
  EXPECT_EQ(mine.at("standings").at("recognition"), "best");
  EXPECT_EQ(json[0].at("methods").at(2).at("standings").at("recognition"), "");
}

TEST(ScoresJson, OfOneRunHaveEveryTargetThatWasJudged) {
  auto stored = made_comparison("a", {{"mine", {kLetters, kLetters}}});
  stored.runs[0].trajectory.judged_from[1].reset();
  const ScoredComparison compared = scored(std::move(stored), {});
  const auto json = nlohmann::json::parse(
      scores_json(compared.stored.runs[0], compared.stored.recording, compared.gate, compared.sheets[0]));
  EXPECT_TRUE(json.at("targets").contains("target 0"));
  EXPECT_FALSE(json.at("targets").contains("target 1"));
  EXPECT_TRUE(json.at("cut_short_at_frame").is_null());
}

/// Of two methods that always hit: the first ten frames are labelled by `ring`, ten by a curve through its answers.
StoredComparison labelled_by_ring() {
  const std::string hits(60, 'H');
  auto stored = made_comparison("a", {{"hybrid(ring,kcf)", {hits}}, {"csrt", {hits}}});
  for (std::size_t frame = 0; frame < 60; ++frame)
    stored.recording.truth_of(frame, 0).source = parse_label_source(frame < 10   ? "detector ring"
                                                                    : frame < 20 ? "spline detector ring"
                                                                                 : "hand");
  return stored;
}

TEST(ScoresJson, TellHowManyLabelsAreFromWhereAndLeaveAMethodsOwnOutOfItsLocalization) {
  const ScoredComparison compared = scored(labelled_by_ring(), {});
  const std::map<std::string, std::size_t> own{{"hybrid(ring,kcf)", 20}, {"csrt", 0}};
  for (std::size_t run = 0; run < 2; ++run) {
    const auto json = nlohmann::json::parse(scores_json(compared.stored.runs[run], compared.stored.recording,
                                                        compared.gate, compared.sheets[run]));
    const auto& pooled = json.at("pooled");
    const std::size_t left_out = own.at(json.at("method"));
    EXPECT_EQ(pooled.at("labels").at("by_source"),
              (nlohmann::json{{"detector ring", 10}, {"spline detector ring", 10}, {"hand", 40}}));
    EXPECT_EQ(pooled.at("labels").at("left_out_of_localization"), left_out);
    EXPECT_EQ(pooled.at("localization").at("hits"), 60 - left_out);
    EXPECT_EQ(pooled.at("localization").at("share_within").at("0.25_d"), 1.0)
        << "of the frames that are left";
    EXPECT_EQ(pooled.at("recognition"), 1.0);
  }
}

TEST(CommonHits, AreNotOnFramesWhoseLabelStemsFromOneOfThem) {
  const ScoredComparison compared = scored(labelled_by_ring(), {});
  for (std::size_t run = 0; run < 2; ++run) {
    EXPECT_EQ(compared.common[run][0].size(), 40u);
    for (const Fix& fix : compared.common[run][0]) EXPECT_GE(fix.frame, 20u);
  }
}

}  // namespace
}  // namespace relock
