#include "cli/compare/changes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/compare/fail_if.h"
#include "core/error.h"
#include "made_comparison.h"

namespace relock {
namespace {

StoredComparison comparison(const std::vector<MadeRun>& runs, const std::string& recording = "a",
                            const MadeConditions& conditions = {}) {
  return made_comparison(recording, runs, conditions);
}
/// Of one run, with the letters of made_comparison.h.
StoredComparison comparison(const std::string& method, const std::string& letters,
                            const std::string& recording = "a", const MadeConditions& conditions = {}) {
  return comparison({{method, {letters}}}, recording, conditions);
}

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

const ScoreChange& score_of(const FolderChange& change, ComparedScore score) {
  return change.groups.at(0).methods.at(0)[score];
}

// Scores

TEST(Compare, TellsNoDifferenceOfAFolderFromItself) {
  const std::vector<StoredComparison> folder{comparison("kcf", with_outages(400, 40, 5))};
  const FolderChange change = changes(folder, folder, {});
  const MethodChange& kcf = change.groups.at(0).methods.at(0);
  EXPECT_TRUE(kcf.same());
  for (const ScoreChange& score : kcf.scores) EXPECT_EQ(score.difference.value_or(0), 0);
  EXPECT_EQ(kcf.count(LossFate::kept), kcf.losses.size());
  EXPECT_GT(kcf.losses.size(), 5u);
  EXPECT_NE(changes_text(change, {"a", "b"}).find("the same answers in A and B: kcf"), std::string::npos);
}

TEST(Compare, HasTheScoresOfTheScoreTables) {
  const std::vector<StoredComparison> a{comparison("kcf", with_outages(400, 40, 5))},
      b{comparison("kcf", with_outages(400, 40, 9))};
  const FolderChange change = changes(a, b, {});
  const Scores before = scores_of(pooled_tables(a).at(0).methods.at(0).tally),
               after = scores_of(pooled_tables(b).at(0).methods.at(0).tally);
  using enum ComparedScore;
  EXPECT_EQ(score_of(change, recognition).before, before.recognition);
  EXPECT_EQ(score_of(change, recognition).after, after.recognition);
  EXPECT_EQ(score_of(change, precision).after, after.precision);
  EXPECT_NEAR(*score_of(change, availability).before, *before.availability, 1e-12);
  EXPECT_NEAR(*score_of(change, availability).after, *after.availability, 1e-12);
  EXPECT_NEAR(*score_of(change, locked_share).after, *after.locked_share, 1e-12);
  EXPECT_NEAR(*score_of(change, losses_per_minute).after, *after.losses_per_minute, 1e-9);
  EXPECT_EQ(score_of(change, losses).before, static_cast<double>(before.losses));
}

TEST(Compare, ChangesItsSignWhenTheFoldersChangePlaces) {
  const std::vector<StoredComparison> a{comparison("kcf", with_outages(400, 40, 5))},
      b{comparison("kcf", with_outages(400, 40, 9))};
  const FolderChange there = changes(a, b, {}), back = changes(b, a, {});
  for (std::size_t i = 0; i < kComparedScores; ++i) {
    const auto score = static_cast<ComparedScore>(i);
    EXPECT_EQ(score_of(there, score).before, score_of(back, score).after);
    EXPECT_NEAR(score_of(there, score).difference.value(), -score_of(back, score).difference.value(), 1e-12);
    EXPECT_EQ(verdict_on(score, score_of(there, score).interval),
              -verdict_on(score, score_of(back, score).interval));
  }
  EXPECT_EQ(there.groups[0].methods[0].count(LossFate::appeared),
            back.groups[0].methods[0].count(LossFate::gone));
}

TEST(Compare, SaysWorseWhereThePairedDifferenceIsSure) {
  const std::vector<StoredComparison> a{comparison("kcf", with_outages(1200, 40, 4))},
      b{comparison("kcf", with_outages(1200, 40, 8))};
  const ScoreChange& recognition = score_of(changes(a, b, {}), ComparedScore::recognition);
  ASSERT_TRUE(recognition.interval);
  EXPECT_LT(recognition.interval->high, 0);
  EXPECT_LT(recognition.interval->low, *recognition.difference);
  EXPECT_EQ(verdict_on(ComparedScore::recognition, recognition.interval), -1);
  EXPECT_EQ(verdict_on(ComparedScore::losses_per_minute, recognition.interval), 1);
}

// Who is compared with whom

TEST(Compare, PairsRunsByRecordingSeedGapsAndProtocol) {
  const std::string held(40, 'H'), lost = std::string(20, 'H') + std::string(20, 'M');
  const std::vector<StoredComparison> a{comparison("kcf", held, "one", {.gaps = "paper", .seed = 1}),
                                        comparison("kcf", lost, "one", {.gaps = "paper", .seed = 2}),
                                        comparison("kcf", held, "two")},
      b{comparison("kcf", lost, "one", {.gaps = "paper", .seed = 2}),
        comparison("kcf", held, "one", {.gaps = "paper", .seed = 1}), comparison("kcf", lost, "two")};
  const FolderChange change = changes(a, b, {});
  ASSERT_EQ(change.groups.size(), 2u);
  EXPECT_EQ(change.groups[0].gaps, "none");
  EXPECT_EQ(change.groups[0].methods.at(0).count(LossFate::appeared), 1u);
  EXPECT_EQ(change.groups[1].gaps, "paper");
  EXPECT_TRUE(change.groups[1].methods.at(0).same());
  EXPECT_EQ(change.groups[1].methods.at(0).runs, 2u);
}

TEST(Compare, CountsRunsOnceThatSayTheSameUnderAnotherSeed) {
  const std::string lost = std::string(20, 'H') + std::string(20, 'M');
  const std::vector<StoredComparison> folder{comparison("kcf", lost, "a", {.seed = 1}),
                                             comparison("kcf", lost, "a", {.seed = 2})};
  EXPECT_EQ(changes(folder, folder, {}).groups.at(0).methods.at(0).runs, 1u);
}

TEST(Compare, SaysWhatIsOnlyInOneFolder) {
  const std::string held(40, 'H');
  const std::vector<StoredComparison> a{comparison({{"kcf", {held}}, {"csrt", {held}}}),
                                        comparison({{"kcf", {held}}}, "old")},
      b{comparison({{"kcf", {held}}, {"ring", {held}}}),
        comparison({{"kcf", {held}}}, "a", {.gaps = "paper", .seed = 3})};
  const FolderChange change = changes(a, b, {});
  EXPECT_EQ(change.only_in_a, (std::vector<std::string>{"recording old (1 run)", "method csrt (1 run)"}));
  EXPECT_EQ(change.only_in_b,
            (std::vector<std::string>{"method ring (1 run)", "kcf on a, gaps paper, seed 3, protocol once"}));
}

TEST(Compare, RefusesFoldersThatHaveNothingInCommon) {
  const std::string held(40, 'H');
  const std::vector<StoredComparison> a{comparison("kcf", held)}, b{comparison("csrt", held)};
  const std::string said = error_of([&] { changes(a, b, {}); });
  EXPECT_NE(said.find("no run in common"), std::string::npos) << said;
  EXPECT_NE(said.find("only in A: method kcf"), std::string::npos) << said;
  EXPECT_NE(said.find("only in B: method csrt"), std::string::npos) << said;
}

TEST(Compare, LeavesARecordingOutThatIsAnotherOneInB) {
  const std::string held(40, 'H');
  const std::vector<StoredComparison> a{comparison("kcf", held), comparison("kcf", held, "b")};
  std::vector<StoredComparison> b = a;
  b[0].runs[0].record.fingerprint = "other labels";
  const FolderChange change = changes(a, b, {});
  ASSERT_EQ(change.left_out.size(), 1u);
  EXPECT_NE(change.left_out[0].find("another recording in B"), std::string::npos);
  EXPECT_EQ(change.groups.at(0).recordings, std::vector<std::string>{"b"});
}

TEST(Compare, PairsMethodsOfDifferentNamesWhereAsked) {
  const std::string held(40, 'H'), lost = std::string(20, 'H') + std::string(20, 'M');
  const std::vector<StoredComparison> folder{
      comparison({{"kcf", {held}}, {"kcf(a=1)", {lost}}, {"csrt", {held}}})};
  const FolderChange change = changes(folder, folder, {}, {parse_method_pair("kcf=kcf(a=1)")});
  ASSERT_EQ(change.groups.at(0).methods.size(), 1u);
  EXPECT_EQ(change.groups[0].methods[0].count(LossFate::appeared), 1u);
  EXPECT_TRUE(change.only_in_a.empty() && change.only_in_b.empty());
  EXPECT_NE(changes_text(change, {"a", "b"}).find("kcf in A, kcf(a=1) in B"), std::string::npos);
  EXPECT_NE(error_of([&] {
              changes(folder, folder, {}, {{"kfc", "csrt"}});
            }).find("did you mean \"kcf\"?"),
            std::string::npos);
  EXPECT_EQ(parse_method_pair("kcf(a=1)=csrt").after, "csrt");
  for (const char* wrong : {"", "kcf", "=kcf", "kcf=", "kcf(a=1)"})
    EXPECT_THROW(parse_method_pair(wrong), Error) << wrong;
}

TEST(Compare, RefusesAFolderThatHasARunTwice) {
  const std::vector<StoredComparison> twice{comparison("kcf", "HHHH"), comparison("kcf", "HHHM")},
      once{comparison("kcf", "HHHH")};
  EXPECT_NE(error_of([&] { changes(twice, once, {}); }).find("twice"), std::string::npos);
  EXPECT_NE(error_of([&] { changes(once, twice, {}); }).find("twice"), std::string::npos);
}

TEST(Compare, LeavesYardsticksOutUnlessNothingElseIsThere) {
  const std::string held(40, 'H');
  const std::vector<StoredComparison> both{comparison({{"kcf", {held}}, {"still", {held}, true}})},
      alone{comparison({{"still", {held}, true}})};
  EXPECT_EQ(changes(both, both, {}).groups.at(0).methods.size(), 1u);
  EXPECT_EQ(changes(alone, alone, {}).groups.at(0).methods.size(), 1u);
}

TEST(Compare, ListsTheLossesThatAreNotTheSame) {
  const std::string a = std::string(30, 'H') + "MMMMM" + std::string(65, 'H'),
                    b = std::string(32, 'H') + "MMMMM" + std::string(43, 'H') + "SSSSS" +
                        std::string(15, 'H');
  const std::string text =
      changes_text(changes({comparison("kcf", a)}, {comparison("kcf", b)}, {}), {"a", "b"});
  EXPECT_NE(text.find("losses of kcf: 1 new, 1 moved"), std::string::npos) << text;
  EXPECT_NE(
      text.find("moved a: lost, and said so, at 1.03 s; recovered in 0.20 s (in B it begins 0.07 s later)"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("new   a: lost silently at 2.63 s"), std::string::npos) << text;
}

// --fail-if

TEST(FailIf, ReadsWhatItIsMadeOf) {
  const FailCondition plain = parse_fail_if("availability drops > 0.02");
  EXPECT_FALSE(plain.method);
  EXPECT_EQ(plain.score, ComparedScore::availability);
  EXPECT_FALSE(plain.rises);
  EXPECT_EQ(plain.by, 0.02);
  EXPECT_FALSE(plain.surely);
  const FailCondition full =
      parse_fail_if(" hybrid(aruco(dictionary=4x4_50),kcf) :losses_per_minute rises>1.5 surely ");
  EXPECT_EQ(full.method, "hybrid(aruco(dictionary=4x4_50),kcf)");
  EXPECT_EQ(full.score, ComparedScore::losses_per_minute);
  EXPECT_TRUE(full.rises);
  EXPECT_EQ(full.by, 1.5);
  EXPECT_TRUE(full.surely);
}

struct Mistake {
  std::string text;
  int character;
  std::string sentence;
};

TEST(FailIf, PointsAtTheCharacterThatIsWrong) {
  const Mistake all[] = {
      {"", 1, "a metric belongs here"},
      {"availabilty drops > 0.02", 1, "did you mean \"availability\"?"},
      {"kcf: speed drops > 1", 6, "no metric is called \"speed\""},
      {": losses rises > 0", 1, "a method's name"},
      {"availability falls > 0.02", 14, "\"drops\" or \"rises\" belongs here, not \"falls\""},
      {"availability", 13, "\"drops\" or \"rises\" belongs here"},
      {"availability drops 0.02", 20, "\">\" and a number belong here"},
      {"availability drops < 0.02", 20, "\">\" and a number belong here"},
      {"availability drops >", 21, "a number from 0"},
      {"availability drops > much", 22, "a number from 0"},
      {"availability drops > -0.1", 22, "a number from 0"},
      {"availability drops > inf", 22, "a number from 0"},
      {"availability drops > 2 %", 24, "0.02, not 2 %"},
      {"availability drops > 0.02 sure", 27, "after \"surely\""},
      {"losses rises > 0 surely", 18, "has no interval"},
  };
  for (const Mistake& mistake : all) {
    const std::string said = error_of([&] { parse_fail_if(mistake.text); });
    EXPECT_NE(said.find(fmt::format("--fail-if, character {}:", mistake.character)), std::string::npos)
        << mistake.text << "\n"
        << said;
    EXPECT_NE(said.find(mistake.sentence), std::string::npos) << said;
    EXPECT_NE(said.find(fmt::format("\n  {:>{}}", '^', mistake.character)), std::string::npos) << said;
  }
}

/// A run that hits `before` of a thousand frames, and one that hits `after`; in outages of many lengths.
FolderChange change_of(const std::string& before, const std::string& after) {
  return changes({comparison("kcf", before)}, {comparison("kcf", after)}, {});
}

TEST(FailIf, HoldsBeyondItsNumberOnly) {
  const FolderChange change = change_of(std::string(100, 'H'), std::string(90, 'H') + std::string(10, 'M'));
  EXPECT_EQ(check(parse_fail_if("recognition drops > 0.09"), change).because.size(), 1u);
  EXPECT_TRUE(check(parse_fail_if("recognition drops > 0.11"), change).because.empty());
  EXPECT_TRUE(check(parse_fail_if("recognition rises > 0"), change).because.empty());
  EXPECT_EQ(check(parse_fail_if("losses rises > 0"), change).because.size(), 1u);
  EXPECT_TRUE(check(parse_fail_if("losses rises > 1"), change).because.empty());
}

TEST(FailIf, SurelyHoldsWhereTheWholeIntervalIsBeyond) {
  const FolderChange change = change_of(with_outages(1200, 40, 4), with_outages(1200, 40, 8));
  const ScoreChange& recognition = score_of(change, ComparedScore::recognition);
  ASSERT_TRUE(recognition.interval);
  const double between = (-*recognition.difference - recognition.interval->high) / 2;
  const auto holds = [&](const std::string& more) {
    return !check(parse_fail_if(fmt::format("recognition drops > {}{}", between, more)), change)
                .because.empty();
  };
  EXPECT_TRUE(holds(""));
  EXPECT_FALSE(holds(" surely"));
  EXPECT_FALSE(check(parse_fail_if("recognition drops > 0 surely"), change).because.empty());
}

TEST(FailIf, CannotBeTakenForPassedWhereAScoreIsNotThereAnyMore) {
  const FolderChange change = change_of(std::string(100, 'H'), std::string(100, '.'));
  const Finding finding = check(parse_fail_if("recognition drops > 0.5"), change);
  EXPECT_TRUE(finding.because.empty());
  ASSERT_EQ(finding.unknown.size(), 1u);
  EXPECT_NE(finding.unknown[0].find("recognition is n/a in B"), std::string::npos);
}

TEST(FailIf, IsHeldAgainstTheMethodThatItNames) {
  const std::string held(40, 'H'), lost = std::string(20, 'H') + std::string(20, 'M');
  const FolderChange change = changes({comparison({{"kcf", {held}}, {"csrt", {held}}})},
                                      {comparison({{"kcf", {lost}}, {"csrt", {held}}})}, {});
  EXPECT_EQ(check(parse_fail_if("losses rises > 0"), change).because.size(), 1u);
  EXPECT_TRUE(check(parse_fail_if("csrt: losses rises > 0"), change).because.empty());
  EXPECT_EQ(check(parse_fail_if("kcf: losses rises > 0"), change).because.size(), 1u);
  EXPECT_NE(error_of([&] {
              check(parse_fail_if("crst: losses rises > 0"), change);
            }).find("did you mean \"csrt\"?"),
            std::string::npos);
}

}  // namespace
}  // namespace relock
