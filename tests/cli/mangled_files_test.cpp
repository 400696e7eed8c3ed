#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "cli/benchmark_files.h"
#include "cli/runs/record.h"
#include "tests/mangled.h"

namespace relock {
namespace {

TEST(MangledRunRecord, IsTakenOrRefusedInASentence) {
  RunRecord record;
  record.recording = "klahaag";
  record.method = "csrt(psr_threshold=0.05)";
  record.options = {{"psr_threshold", "0.05"}};
  record.gaps = "bernoulli(0.1)";
  record.dropped = {3, 4, 9};
  record.judged_from = {0, std::nullopt};
  record.failed_from = {std::nullopt, std::nullopt};
  record.failures = {{7, "threw", "tail"}};
  expect_taken_or_refused(to_json_text(record), "run.json",
                          [](const std::string& copy) { parse_record(copy, "run.json"); });
}

/// A file whose text is changed again and again, gone at the end.
class ChangingFile {
 public:
  ~ChangingFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& holding(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }
  std::string name() const { return path_.filename().string(); }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("relock-mangled-" + std::to_string(getpid()) + ".txt");
};

void expect_results_taken_or_refused(ResultFormat format, const std::string& right) {
  const ChangingFile file;
  expect_taken_or_refused(
      right, file.name(), [&](const std::string& copy) { read_answers(format, file.holding(copy)); }, 200);
}

TEST(MangledResultFiles, OfOtbAreTakenOrRefusedInASentence) {
  expect_results_taken_or_refused(ResultFormat::otb, "10,20,30,40\n11.5,20,30,40\n0,0,0,0\n12,21,30,40\n");
}
TEST(MangledResultFiles, OfGot10kAreTakenOrRefusedInASentence) {
  expect_results_taken_or_refused(ResultFormat::got10k, "10.0,20.0,30.0,40.0\n0,0,0,0\n12.25,21,30,40\n");
}
TEST(MangledResultFiles, OfVotAreTakenOrRefusedInASentence) {
  expect_results_taken_or_refused(ResultFormat::vot,
                                  "1\n10,20,30,40\n2\n0\n0\n0\n0\n1\n1.5,2,30,2,30,40,1.5,40\n");
}

}  // namespace
}  // namespace relock
