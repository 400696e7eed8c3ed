#include "eval/judgement/matching.h"

#include <algorithm>
#include <compare>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace relock {
namespace {

/// What a set of pairs costs: less is better, compared Hits first, then pairs, then distance. Costs add and
/// subtract member by member and are ordered like words, which is all that the Hungarian method asks of them.
struct Cost {
  std::int64_t hits = 0, pairs = 0, distance = 0;
  friend auto operator<=>(const Cost&, const Cost&) = default;
  friend Cost operator+(Cost a, Cost b) {
    return {a.hits + b.hits, a.pairs + b.pairs, a.distance + b.distance};
  }
  friend Cost operator-(Cost a, Cost b) {
    return {a.hits - b.hits, a.pairs - b.pairs, a.distance - b.distance};
  }
};
constexpr Cost kForbidden{1'000'000'000, 0, 0};  // more Hits than any frame could lose
constexpr Cost kUnreached{std::numeric_limits<std::int64_t>::max() / 4, 0, 0};

/// Rows are targets; columns are sightings and, behind them, one "takes none" for each target.
using Matrix = std::vector<std::vector<Cost>>;

struct Assignment {
  std::vector<int> column_of;   // for each row
  std::vector<Cost> row_price;  // dual prices: cost - row - column >= 0 everywhere, 0 on pairs of an optimum
  std::vector<Cost> column_price;
  Cost total;
};

/// The Hungarian method with shortest augmenting paths (Jonker and Volgenant 1987), rows <= columns.
Assignment assign(const Matrix& cost) {
  const std::size_t rows = cost.size(), columns = cost[0].size();
  // Index 0 of the column arrays stands for "no column yet": rows are entered there one by one.
  std::vector<Cost> u(rows + 1), v(columns + 1);
  std::vector<std::size_t> row_at(columns + 1, 0), came_from(columns + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row) {
    row_at[0] = row;
    std::size_t column = 0;
    std::vector<Cost> shortest(columns + 1, kUnreached);
    std::vector<bool> done(columns + 1, false);
    do {
      done[column] = true;
      const std::size_t from = row_at[column];
      Cost step = kUnreached;
      std::size_t next = 0;
      for (std::size_t j = 1; j <= columns; ++j) {
        if (done[j]) continue;
        const Cost reduced = cost[from - 1][j - 1] - u[from] - v[j];
        if (reduced < shortest[j]) shortest[j] = reduced, came_from[j] = column;
        if (shortest[j] < step) step = shortest[j], next = j;
      }
      for (std::size_t j = 0; j <= columns; ++j) {
        if (done[j]) {
          u[row_at[j]] = u[row_at[j]] + step;
          v[j] = v[j] - step;
        } else {
          shortest[j] = shortest[j] - step;
        }
      }
      column = next;
    } while (row_at[column] != 0);
    for (; column != 0; column = came_from[column]) row_at[column] = row_at[came_from[column]];
  }

  Assignment result{std::vector<int>(rows, -1), {u.begin() + 1, u.end()}, {v.begin() + 1, v.end()}, {}};
  for (std::size_t j = 1; j <= columns; ++j) {
    if (row_at[j] == 0) continue;
    result.column_of[row_at[j] - 1] = static_cast<int>(j - 1);
    result.total = result.total + cost[row_at[j] - 1][j - 1];
  }
  return result;
}

/// Among all optimal assignments the one in which the first row has the earliest column of its preference,
/// then the second, and so on.
std::vector<int> first_of_the_best(Matrix cost, const std::vector<std::vector<int>>& preference) {
  Assignment best = assign(cost);
  const Cost optimum = best.total;
  for (std::size_t row = 0; row < cost.size(); ++row) {
    for (const int column : preference[row]) {
      const auto j = static_cast<std::size_t>(column);
      if (column == best.column_of[row]) break;
      // Only pairs of no reduced cost can belong to an optimum.
      if (cost[row][j] - best.row_price[row] - best.column_price[j] != Cost{}) continue;
      Matrix forced = cost;
      std::fill(forced[row].begin(), forced[row].end(), kForbidden);
      forced[row][j] = cost[row][j];
      Assignment other = assign(forced);
      if (other.total != optimum) continue;
      best = std::move(other);
      cost = std::move(forced);
      break;
    }
    const auto chosen = static_cast<std::size_t>(best.column_of[row]);
    const Cost kept = cost[row][chosen];
    std::fill(cost[row].begin(), cost[row].end(), kForbidden);
    cost[row][chosen] = kept;
  }
  return best.column_of;
}

/// Candidates (by index) that hang together through common targets or sightings: their matchings do not
/// touch.
std::vector<std::vector<std::size_t>> connected(const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> parent(candidates.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<int, std::size_t> first_of_target, first_of_sighting;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto join = [&](std::map<int, std::size_t>& first, int key) {
      const auto [at, fresh] = first.emplace(key, i);
      if (!fresh) parent[root(i)] = root(at->second);
    };
    join(first_of_target, candidates[i].target);
    join(first_of_sighting, candidates[i].sighting);
  }
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < candidates.size(); ++i) groups[root(i)].push_back(i);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [key, members] : groups) all.push_back(std::move(members));
  return all;
}

/// Ranks of the distinct values in order of first appearance.
std::map<int, std::size_t> ranks(const std::vector<Candidate>& candidates,
                                 const std::vector<std::size_t>& members, int Candidate::*key) {
  std::map<int, std::size_t> rank;
  for (const std::size_t i : members) rank.emplace(candidates[i].*key, rank.size());
  return rank;
}

void match_group(const std::vector<Candidate>& candidates, const std::vector<std::size_t>& members,
                 std::vector<bool>& paired) {
  const auto row_of = ranks(candidates, members, &Candidate::target);
  const auto column_of = ranks(candidates, members, &Candidate::sighting);
  const std::size_t rows = row_of.size(), columns = column_of.size();
  Matrix cost(rows, std::vector<Cost>(columns + rows, kForbidden));
  std::vector<std::vector<int>> preference(rows);
  for (const std::size_t i : members) {
    const Candidate& c = candidates[i];
    const std::size_t row = row_of.at(c.target), column = column_of.at(c.sighting);
    cost[row][column] = {c.hit ? -1 : 0, -1, c.distance};
    preference[row].push_back(static_cast<int>(column));
  }
  for (std::size_t row = 0; row < rows; ++row) {
    cost[row][columns + row] = Cost{};
    preference[row].push_back(static_cast<int>(columns + row));
  }
  const auto chosen = first_of_the_best(std::move(cost), preference);
  for (const std::size_t i : members)
    paired[i] =
        chosen[row_of.at(candidates[i].target)] == static_cast<int>(column_of.at(candidates[i].sighting));
}

}  // namespace

std::vector<bool> match(const std::vector<Candidate>& candidates) {
  std::vector<bool> paired(candidates.size(), false);
  if (candidates.size() == 1) {  // nearly every frame
    paired[0] = true;
    return paired;
  }
  for (const auto& members : connected(candidates)) match_group(candidates, members, paired);
  return paired;
}

}  // namespace relock
