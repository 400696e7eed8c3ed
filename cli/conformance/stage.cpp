#include "cli/conformance/stage.h"

#include <new>

namespace relock {

void Stage::at(std::string place) {
  place_ = std::move(place);
  tell_("a" + place_);
}

std::string Stage::what_was_thrown() {
  try {
    throw;
  } catch (const Error& fault) {
    return fmt::format("threw the Error \"{}\"", fault.what());
  } catch (const std::bad_alloc&) {
    return "ran out of memory";
  } catch (const std::exception& fault) {
    return fmt::format("threw \"{}\", which is no Error", fault.what());
  } catch (...) {
    return "threw something that is no exception";
  }
}

StageReport read_report(const std::vector<std::string>& messages) {
  StageReport report;
  for (const std::string& message : messages) {
    const std::string text = message.substr(1);
    switch (message[0]) {
      case 'a':
        report.place = text;
        break;
      case 's':
        report.answers.push_back(report.place + ": " + text);
        break;
      case 'p':
        report.note = text;
        break;
      case 'n':
        report.not_asked = text;
        break;
      default:
        report.reason = text;
    }
  }
  return report;
}

}  // namespace relock
