#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/looks.h"
#include "cli/catalogue.h"
#include "cli/method_spec.h"
#include "eval/statistics/interval.h"

// `relock bench ring`: is the detector as good as it is meant to be?

namespace relock::bench {

struct Settings {
  MethodSpec method{"ring", {}};
  Seeds seeds = Seeds::odd;
  std::optional<std::size_t> pictures = {};  ///< of every kind; else what `full` says
  bool full = false;                         ///< as many as it takes to tell; else a sample
  int jobs = 1;
};

/// What is to be reached.
struct Goal {
  enum class Sense : std::uint8_t { least, most };  ///< a rate is to be at least, an error at most
  Sense sense = Sense::least;
  std::optional<double> must = {}, aim = {};
  std::size_t pictures_for_must = 0, pictures_for_aim = 0;  ///< that it takes at least to say so
};

/// One line of the acceptance table.
struct Measured {
  std::string row;   ///< as --only takes it
  std::string what;  ///< "clutter, D 150, blur 65 px"
  std::string unit;  ///< "%", "px", "degrees"
  std::optional<double> value = {};
  std::optional<Interval> interval = {};
  std::size_t pictures = 0;  ///< that it rests on
  Goal goal = {};
  std::string detail = {};  ///< what else is to be told
};

/// "aim", "must" or "missed"; with a question mark where the interval holds the other side of it. "too few" where it was
/// not missed, but on too few pictures; "n/a" without a value, "reported" without a goal.
std::string verdict_of(const Measured& measured);

/// Share of `looks` that were recognised, %, with Wilson's interval: pictures are independent.
Measured recognised(const std::string& row, const std::string& what, const std::vector<Look>& looks,
                    const Goal& goal);
/// Median with the interval between two order statistics that holds the true one with 95 %. Values are independent.
Measured median(const std::string& row, const std::string& what, const std::string& unit,
                std::vector<double> values, const Goal& goal);

/// The detector at work on made pictures.
class Bench {
 public:
  /// `methods` must outlive it. Throws Error on a method that is no detector or reads no rings.
  Bench(const Settings& settings, const Methods& methods);

  const Settings& settings() const { return settings_; }
  /// The rings that the method is asked to find, one for each of its codes.
  const std::vector<PrintedTarget>& targets() const { return targets_; }
  /// Pictures of a kind: `sample` without --full, `full` with it, or what --pictures says.
  std::size_t count(std::size_t sample, std::size_t full) const;
  /// Makes pictures and looks at them, once for each kind.
  const std::vector<Look>& looks(const PictureKind& kind, std::size_t count);
  /// All that were made so far.
  const std::map<std::string, std::vector<Look>>& all() const { return looks_; }
  std::unique_ptr<Detector> make_detector() const { return entry_->make(options_, 1); }
  /// Another detector of the program, as it comes. Throws Error when there is none.
  std::unique_ptr<Detector> make_other(const std::string& name) const;

 private:
  Settings settings_;
  const Methods& methods_;
  const DetectorEntry* entry_;
  Options options_;
  std::vector<PrintedTarget> targets_;
  std::map<std::string, std::vector<Look>> looks_;
};

}  // namespace relock::bench
