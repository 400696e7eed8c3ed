#include "cli/gains.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "cli/combinations.h"
#include "cli/comparison.h"
#include "core/error.h"
#include "eval/scores/common_frames.h"

namespace relock {
namespace {

/// A method in the results: its arms, in the order of the results.
struct Member {
  std::string method;
  MethodSpec spec;
  std::vector<const Arms*> arms;
};

std::vector<Member> members_of(const std::vector<Arms>& all) {
  std::vector<Member> members;
  for (const Arms& arms : all) {
    if (arms.with.record.yardstick) continue;
    const std::string& method = arms.with.record.method;
    auto found = std::find_if(members.begin(), members.end(),
                              [&](const Member& member) { return member.method == method; });
    if (found == members.end())
      found = members.insert(members.end(), Member{method, parse_methods(method).front(), {}});
    found->arms.push_back(&arms);
  }
  return members;
}

std::optional<std::string> tracker_name(const Member& member) {
  const auto tracker = tracker_in(member.spec);
  return tracker ? std::optional(tracker->text()) : std::nullopt;
}

bool is_alone(const Member& member) {
  return !is_combination(member.spec.name) || member.spec.name == "track" || member.spec.name == "detect";
}

std::string column_of(const Member& member) {
  return is_alone(member) ? "alone" : with_tracker(member.spec, "T").text();
}

/// Columns stand in this order: the method alone, combinations that are trackers, the others.
auto place_of(const Member& member) {
  const auto& names = combination_names();
  const auto kind = std::find(names.begin(), names.end(), member.spec.name) - names.begin();
  return std::tuple(!is_alone(member), !is_tracker_combination(member.spec.name), is_alone(member) ? 0 : kind,
                    column_of(member));
}

bool stands_before(const Member* a, const Member* b) { return place_of(*a) < place_of(*b); }

std::vector<std::string> columns_of(const std::vector<Member>& members) {
  std::set<decltype(place_of(members.front()))> places;
  for (const Member& member : members) places.insert(place_of(member));
  std::vector<std::string> columns;
  for (const auto& place : places) columns.push_back(std::get<std::string>(place));
  columns.erase(std::unique(columns.begin(), columns.end()),
                columns.end());  // kcf and track(kcf) are both alone
  return columns;
}

/// The arms of `member` on the same recording with the same gaps; nothing when there are none.
const Arms* arms_like(const Arms& arms, const Member& member) {
  const auto alike = [&](const Arms* other) {
    const RunRecord &a = arms.with.record, &b = other->with.record;
    return a.recording == b.recording && a.fingerprint == b.fingerprint && a.seed == b.seed;
  };
  const auto found = std::find_if(member.arms.begin(), member.arms.end(), alike);
  return found == member.arms.end() ? nullptr : *found;
}

/// The arms of all members on one recording.
using FamilyArms = std::vector<EquallyLong>;

/// Cut to the shortest, where a run was cut short.
FamilyArms cut_alike(FamilyArms members) {
  std::size_t frames = members.front().recording.frames();
  for (const EquallyLong& member : members) frames = std::min(frames, member.recording.frames());
  for (EquallyLong& member : members)
    member = {up_to(member.recording, frames), up_to(member.without, frames), up_to(member.with, frames)};
  return members;
}

Family family_of(const FamilyArms& members) {
  Family family{members.front().recording, {}};
  for (const EquallyLong& member : members)
    family.members.push_back({member.recording, member.without, member.with});
  return family;
}

/// Of every pair of the first member the arms of all, where all have it.
std::vector<FamilyArms> families_of(const std::vector<const Member*>& members) {
  std::vector<FamilyArms> families;
  for (const Arms* alone : members.front()->arms) {
    FamilyArms family;
    for (const Member* member : members)
      if (const Arms* arms = arms_like(*alone, *member)) family.push_back(equally_long(*arms));
    if (family.size() == members.size()) families.push_back(cut_alike(std::move(family)));
  }
  return families;
}

GainRow row_of(const std::vector<const Member*>& members, const Gate& gate) {
  const Member& alone = *members.front();
  GainRow row{.tracker = alone.spec.text(), .methods = {}, .columns = {}, .gain = {}};
  for (const Member* member : members) {
    row.methods.push_back(member->method);
    row.columns.push_back(column_of(*member));
    row.deterministic = row.deterministic && member->arms.front()->with.record.deterministic;
  }
  const auto arms = families_of(members);
  row.pairs = arms.size();
  row.known_pairs = alone.arms.size();
  std::vector<Family> families;
  for (const FamilyArms& one : arms) families.push_back(family_of(one));
  row.gain = gain_of(families, gate);
  return row;
}

GainExperiment experiment_on(const std::vector<Arms>& all, const std::optional<std::string>& gate) {
  GainExperiment experiment{paired_conditions(all, gate), {}, {}, {}};
  const std::vector<Member> members = members_of(all);
  experiment.columns = columns_of(members);
  std::map<std::string, std::vector<const Member*>> combined;
  for (const Member& member : members)
    if (!is_alone(member)) combined[tracker_name(member).value_or("")].push_back(&member);
  for (const Member& alone : members) {
    if (!is_alone(alone)) continue;
    std::vector<const Member*> row{&alone};
    if (const auto of = combined.find(tracker_name(alone).value_or(alone.method)); of != combined.end()) {
      std::sort(of->second.begin(), of->second.end(), stands_before);
      row.insert(row.end(), of->second.begin(), of->second.end());
      combined.erase(of);
    }
    experiment.rows.push_back(row_of(row, experiment.gate));
  }
  for (const auto& [tracker, left] : combined)
    for (const Member* member : left) experiment.alone_is_missing.push_back(member->method);
  std::stable_partition(experiment.rows.begin(), experiment.rows.end(),
                        [](const GainRow& row) { return row.methods.size() > 1; });
  return experiment;
}

}  // namespace

std::vector<GainExperiment> gain_experiments(const std::vector<StoredComparison>& comparisons,
                                             const std::optional<std::string>& gate) {
  std::vector<GainExperiment> experiments;
  for (const std::vector<Arms>& arms : arms_by_pattern(comparisons))
    experiments.push_back(experiment_on(arms, gate));
  const auto compares = [](const GainExperiment& e) {
    return std::any_of(e.rows.begin(), e.rows.end(),
                       [](const GainRow& row) { return row.methods.size() > 1; });
  };
  if (std::none_of(experiments.begin(), experiments.end(), compares))
    throw Error(
        "no combination there stands beside the tracker in it; run both: --methods 'kcf,gap-aware(kcf)'");
  return experiments;
}

CostScore gain_score(const std::string& word) {
  const std::map<std::string, CostScore> words{{"locked-share", CostScore::locked_share},
                                               {"recognition", CostScore::recognition},
                                               {"availability", CostScore::availability},
                                               {"losses", CostScore::losses_per_minute}};
  if (const auto found = words.find(word); found != words.end()) return found->second;
  throw Error("--score " + word + " is none; they are locked-share, recognition, availability and losses");
}

}  // namespace relock
