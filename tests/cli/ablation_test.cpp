#include "cli/reproduce/ablation.h"

#include <gtest/gtest.h>

namespace relock::reproduction {
namespace {

/// Four flights in every cell: `losses` of a hundred minutes, and as many more as the flight's number.
void add(std::vector<GapCount>& counts, const std::string& method, std::size_t losses) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const bool blurred : {false, true})
      for (const GapArm arm : {GapArm::all_frames, GapArm::gaps}) {
        GapCount count{.method = method, .cell = {arm, blurred, seed}};
        count.losses = losses + seed;
        count.held_minutes = 100;
        counts.push_back(count);
      }
}

TEST(AnAblation, NamesWhatLosesTheTargetMoreOftenAndNothingElse) {
  std::vector<GapCount> counts;
  add(counts, "blut", 100);
  add(counts, "blut(blur_lobes=false)", 300);
  add(counts, "blut(update=false)", 100);
  add(counts, "l1", 50);
  const Finding finding = finding_of_ablation(counts);
  ASSERT_EQ(finding.sentences.size(), 1u);
  EXPECT_EQ(finding.sentences.front(),
            "Seen to lose the target more often than blut somewhere: blut(blur_lobes=false).");
}

TEST(AnAblation, ComparesFlightByFlightSoThatWhatFlightsDifferInCancels) {
  std::vector<GapCount> counts;
  add(counts, "blut", 100);
  add(counts, "ivt", 300);
  const std::string table = finding_of_ablation(counts).tables.at(1).text(0);
  EXPECT_NE(table.find("2.0 [2.0, 2.0]"), std::string::npos) << table;
  EXPECT_EQ(table.find("blut  "), std::string::npos) << table;
}

TEST(AnAblation, LeavesOutWhatWasNotRun) {
  std::vector<GapCount> counts;
  add(counts, "blut", 100);
  const Finding finding = finding_of_ablation(counts);
  EXPECT_EQ(finding.sentences.front(),
            "On these flights no change to blut is seen to lose the target more often.");
  EXPECT_EQ(finding.tables.at(0).text(0).find("ivt"), std::string::npos);
}

}  // namespace
}  // namespace relock::reproduction
