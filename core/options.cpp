#include "core/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/nearest.h"

namespace relock {

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

}  // namespace relock
