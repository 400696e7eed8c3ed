#include "cli/readable.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/runs/copies.h"
#include "core/error.h"

namespace relock {

int tell_left_out(const std::vector<std::string>& sentences) {
  std::fflush(stdout);
  for (const std::string& why : sentences) fmt::print(stderr, "relock: {} (left out)\n", why);
  return sentences.empty() ? 0 : 2;
}

int with_readable(const std::vector<FoundComparison>& found, const UseResults& use) {
  std::vector<StoredComparison> results;
  std::vector<std::string> unreadable;
  KnownRecordings known;
  for (const FoundComparison& comparison : found) {
    auto stored = read_comparison(comparison, [&](const std::string& why) { unreadable.push_back(why); });
    if (!stored) continue;
    try {
      known.check(*stored);
      results.push_back(*std::move(stored));
    } catch (const Error& fault) {
      unreadable.push_back(fault.what());
    }
  }
  try {
    if (!results.empty()) use(std::move(results));
  } catch (const Error&) {  // it may well come from what is missing
    tell_left_out(unreadable);
    throw;
  }
  return tell_left_out(unreadable);
}

}  // namespace relock
