#include "cli/compare/run_pairs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "cli/runs/copies.h"
#include "core/error.h"
#include "core/nearest.h"
#include "eval/loss_text.h"

namespace relock {
namespace {

/// What a run is found again by.
using Key = std::tuple<std::string, std::string, std::uint64_t, Showing, std::string, std::string>;
constexpr std::size_t kMethodOfKey = 5;
Key key_of(const RunRecord& r) { return {r.recording, r.gaps, r.seed, r.showing(), r.gate, r.method}; }

struct Place {
  const StoredComparison* comparison;
  const StoredRun* run;
};
using Places = std::map<Key, Place>;

Places places_of(const std::vector<StoredComparison>& all) {
  Places places;
  for (const StoredComparison& comparison : all)
    for (const StoredRun& run : comparison.runs) {
      const auto [known, is_new] = places.insert({key_of(run.record), {&comparison, &run}});
      if (!is_new)
        throw Error(
            fmt::format("{} and {} are the same run twice; compare two results folders, not folders of "
                        "several",
                        known->second.run->folder.string(), run.folder.string()));
    }
  return places;
}

bool only_yardsticks(const std::vector<StoredComparison>& all) {
  for (const StoredComparison& comparison : all)
    for (const StoredRun& run : comparison.runs)
      if (!run.record.yardstick) return false;
  return true;
}

// Who is not in the other folder

std::string conditions_text(const RunRecord& r) {
  return fmt::format("{}, {}, {}", r.recording,
                     r.gaps == "none" ? "as recorded" : fmt::format("gaps {}, seed {}", r.gaps, r.seed),
                     spoken(r.showing()));
}

std::string counted_runs(std::size_t runs) { return runs == 1 ? "1 run" : fmt::format("{} runs", runs); }

/// In words, as short as they can be: a method or a recording that the other folder has nowhere is one word.
std::vector<std::string> told_only(const std::vector<const RunRecord*>& missing, const Places& other) {
  std::set<std::string> methods, recordings;
  for (const auto& [key, place] : other) {
    methods.insert(place.run->record.method);
    recordings.insert(place.run->record.recording);
  }
  std::map<std::string, std::size_t> whole_recordings, whole_methods;
  std::map<std::string, std::set<std::string>> the_rest;  // methods, by conditions
  for (const RunRecord* record : missing) {
    if (!recordings.contains(record->recording))
      ++whole_recordings[record->recording];
    else if (!methods.contains(record->method))
      ++whole_methods[record->method];
    else
      the_rest[conditions_text(*record)].insert(record->method);
  }
  std::vector<std::string> sentences;
  for (const auto& [name, runs] : whole_recordings)
    sentences.push_back(fmt::format("recording {} ({})", name, counted_runs(runs)));
  for (const auto& [name, runs] : whole_methods)
    sentences.push_back(fmt::format("method {} ({})", name, counted_runs(runs)));
  for (const auto& [conditions, names] : the_rest)
    sentences.push_back(fmt::format("{} on {}", joined({names.begin(), names.end()}), conditions));
  return sentences;
}

/// Which runs are asked about, and what their method is called in the other folder.
class Counterparts {
 public:
  /// `yardsticks_too`: where methods are not named.
  Counterparts(std::vector<MethodPair> methods, bool yardsticks_too)
      : methods_(std::move(methods)), yardsticks_too_(yardsticks_too) {}
  Counterparts turned() const {
    Counterparts other = *this;
    for (MethodPair& pair : other.methods_) std::swap(pair.before, pair.after);
    return other;
  }

  /// Of a run, where it is to be found in the other folder; nothing when it is not asked about.
  std::vector<Key> of(const RunRecord& record) const {
    if (methods_.empty() && record.yardstick && !yardsticks_too_) return {};
    if (methods_.empty()) return {key_of(record)};
    std::vector<Key> keys;
    for (const MethodPair& pair : methods_) {
      if (pair.before != record.method) continue;
      keys.push_back(key_of(record));
      std::get<kMethodOfKey>(keys.back()) = pair.after;
    }
    return keys;
  }

 private:
  std::vector<MethodPair> methods_;
  bool yardsticks_too_;
};

std::vector<std::string> only_in(const std::vector<StoredComparison>& all, const Places& other,
                                 const Counterparts& counterparts) {
  std::vector<const RunRecord*> missing;
  for (const StoredComparison& comparison : all)
    for (const StoredRun& run : comparison.runs) {
      const auto keys = counterparts.of(run.record);
      const auto is_there = [&](const Key& key) { return other.contains(key); };
      if (!keys.empty() && std::none_of(keys.begin(), keys.end(), is_there)) missing.push_back(&run.record);
    }
  return told_only(missing, other);
}

void check_method(const std::string& method, const Places& places, const char* folder) {
  std::vector<std::string> names;
  for (const auto& [key, place] : places) names.push_back(place.run->record.method);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (std::find(names.begin(), names.end(), method) == names.end())
    throw Error(fmt::format("--pair: {} has no method {}{}; it has {}", folder, method,
                            did_you_mean(method, names), joined(names)));
}

// Who is

/// Why two runs of one name cannot be compared; empty when they can.
std::string at_odds(const RunRecord& a, const RunRecord& b) {
  if (a.fingerprint != b.fingerprint)
    return fmt::format("{} is another recording in B: its pictures, times or labels are not the same",
                       a.recording);
  if (a.dropped != b.dropped)
    return fmt::format("{}: gaps {} take other frames in B than in A", a.recording, a.gaps);
  return "";
}

std::string nothing_in_common(const RunPairs& found) {
  std::vector<std::string> why = found.left_out;
  if (!found.only_in_a.empty()) why.push_back("only in A: " + joined(found.only_in_a));
  if (!found.only_in_b.empty()) why.push_back("only in B: " + joined(found.only_in_b));
  return fmt::format(
      "A and B have no run in common: a run has the same recording, method, gaps, seed and protocol in both "
      "({})",
      fmt::join(why, "; "));
}

}  // namespace

MethodPair parse_method_pair(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (text[i] == '=' && depth == 0 && i > 0 && i + 1 < text.size())
      return {std::string(text.substr(0, i)), std::string(text.substr(i + 1))};
  }
  throw Error(fmt::format("--pair {}: a method of A, = and a method of B belong here: kcf=csrt", text));
}

RunPairs run_pairs(const std::vector<StoredComparison>& a, const std::vector<StoredComparison>& b,
                   const std::vector<MethodPair>& methods) {
  const Places in_a = places_of(a), in_b = places_of(b);
  for (const auto& [before, after] : methods) check_method(before, in_a, "A"), check_method(after, in_b, "B");
  const Counterparts counterparts(methods, only_yardsticks(a) && only_yardsticks(b));
  RunPairs found{{}, only_in(a, in_b, counterparts), only_in(b, in_a, counterparts.turned()), {}};
  std::set<
      std::tuple<std::string, std::string, std::string, std::string, Showing, std::uint64_t, std::uint64_t>>
      known;
  const auto add = [&](const StoredComparison& comparison, const StoredRun& before, const StoredRun& after) {
    const RunRecord& record = before.record;
    if (const std::string why = at_odds(record, after.record); !why.empty()) {
      if (std::find(found.left_out.begin(), found.left_out.end(), why) == found.left_out.end())
        found.left_out.push_back(why);
    } else if (known
                   .insert({record.recording, record.method, after.record.method, record.gaps,
                            record.showing(), hash_of_answers(before), hash_of_answers(after)})
                   .second) {
      found.pairs.push_back({&comparison, &before, &after});
    }
  };
  for (const StoredComparison& comparison : a)
    for (const StoredRun& run : comparison.runs)
      for (const Key& key : counterparts.of(run.record))
        if (const auto other = in_b.find(key); other != in_b.end()) add(comparison, run, *other->second.run);
  if (found.pairs.empty()) throw Error(nothing_in_common(found));
  return found;
}

}  // namespace relock
