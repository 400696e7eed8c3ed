#include "core/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

template <class Number>
bool parse(const std::string& text, Number& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Options::Options(std::string owner, const std::vector<OptionInfo>& known,
                 const std::map<std::string, std::string>& given)
    : owner_(std::move(owner)) {
  std::vector<std::string> names;
  for (const OptionInfo& info : known) {
    names.push_back(info.name);
    values_[info.name] = info.default_value;
  }
  for (const auto& [name, value] : given) {
    const auto place = values_.find(name);
    if (place == values_.end()) {
      const std::string all =
          names.empty() ? "it has none" : fmt::format("it has {}", fmt::join(names, ", "));
      throw Error(fmt::format("{} has no option \"{}\"{}; {}", owner_, name, did_you_mean(name, names), all));
    }
    place->second = value;
  }
}

double Options::number(std::string_view name, double least, double most) const {
  double value = 0;
  if (!parse(word(name), value) || !std::isfinite(value) || value < least || value > most)
    refuse(name, fmt::format("a number from {} to {}", least, most));
  return value;
}

int Options::whole(std::string_view name, int least, int most) const {
  int value = 0;
  if (!parse(word(name), value) || value < least || value > most)
    refuse(name, fmt::format("a whole number from {} to {}", least, most));
  return value;
}

bool Options::flag(std::string_view name) const { return word(name, {"false", "true"}) == "true"; }

const std::string& Options::word(std::string_view name) const { return values_.at(std::string(name)); }

const std::string& Options::word(std::string_view name, const std::vector<std::string>& legal) const {
  const std::string& value = word(name);
  if (std::find(legal.begin(), legal.end(), value) == legal.end())
    refuse(name, fmt::format("one of {}", fmt::join(legal, ", ")));
  return value;
}

void Options::refuse(std::string_view name, std::string_view legal) const {
  throw Error(fmt::format("{}: option {} is \"{}\"; it must be {}", owner_, name, word(name), legal));
}

}  // namespace relock
