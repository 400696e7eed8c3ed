#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>

#include "cli/conformance/checks.h"

// What an entry says of itself, and the films that are hard to watch.

namespace relock {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kUnits{
    {{"_px", "px"}, {"_s", "s"}, {"_ms", "ms"}, {"_hz", "Hz"}, {"_rad", "rad"}, {"_deg", "deg"}}};

void check_option(const OptionInfo& option, Stage& stage) {
  stage.at("option " + option.name);
  if (option.name.empty()) stage.fail("it has no name");
  if (option.sentence.empty()) stage.fail("it has no sentence that says what it does");
  for (const auto& [ending, unit] : kUnits)
    if (option.name.ends_with(ending) && option.unit != unit)
      stage.fail(fmt::format("its name ends in {} and its unit is \"{}\"", ending, option.unit));
}

Note options(const Subject& subject, const MemoryLimits&, Stage& stage) {
  stage.at("entry");
  if (subject.sentence().empty()) stage.fail("it has no sentence that says what it is");
  std::set<std::string> names;
  std::map<std::string, std::string> typed;
  for (const OptionInfo& option : subject.option_list()) {
    check_option(option, stage);
    if (!names.insert(option.name).second) stage.fail("there are two of this name");
    typed[option.name] = option.default_value;
  }
  stage.at("its defaults, typed as they are listed");
  Subject as_typed = subject;
  stage.call([&] {
    as_typed.options = Options(subject.name(), subject.option_list(), typed);
    session(as_typed, 1);
  });
  return {};
}

template <Film (*film)(const Scene&, const Box&)>
Note well_formed_throughout(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const Stand stand = usual_stand(subject);
  const auto one = stage.call([&] { return session(subject, 1); });
  show(subject, *one, film(stand.scene, stand.start), stage);
  return {};
}

Note grey(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const Stand stand = usual_stand(subject);
  const Refusal refusal = subject.detector ? Refusal::is_allowed : Refusal::fails;
  for (const PixelFormat first : {PixelFormat::bgr8, PixelFormat::gray8}) {
    const auto one = stage.call([&] { return session(subject, 1); });
    show(subject, *one, grey_between(stand.scene, stand.start, first), stage, refusal);
  }
  return {};
}

}  // namespace

std::vector<Check> entry_checks() { return {{"options", options}}; }

std::vector<Check> film_checks() {
  return {{"leaves", well_formed_throughout<leaving>},
          {"shrinks", well_formed_throughout<shrinking>},
          {"vanishes", well_formed_throughout<vanishing>},
          {"blank", well_formed_throughout<blank>},
          {"grey", grey},
          {"gaps", well_formed_throughout<gappy>}};
}

}  // namespace relock
