#include "cli/report/page.h"

#include <algorithm>
#include <string_view>

namespace relock::reports {
namespace {

constexpr std::string_view kDataPlace = "{\"relock\": \"data\"}", kWordsPlace = "<!-- words -->";

/// JSON without '<': nothing in it is taken for a tag.
std::string as_data(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    c == '<' ? text += "\\u003c" : text += c;
  return text;
}

std::string as_text(const std::string& words) {
  std::string text;
  for (const char c : words) {
    if (c == '<')
      text += "&lt;";
    else if (c == '>')
      text += "&gt;";
    else if (c == '&')
      text += "&amp;";
    else if (c == '"')
      text += "&quot;";
    else
      text += c;
  }
  return text;
}

/// For readers whose mail shows pages without running their scripts.
std::string words_of(const Json& data) {
  std::string text;
  for (const Json& table : data.at("tables")) {
    text += "<h2>" + as_text(table.at("heading").get<std::string>()) + "</h2><p>";
    for (const Json& sentence : table.at("words")) text += as_text(sentence.get<std::string>()) + " ";
    text += "</p>";
  }
  return text;
}

void put(std::string& page, std::string_view place, const std::string& text) {
  page.replace(page.find(place), place.size(), text);
}

}  // namespace

std::string page(const Json& data) {
  std::string text = kPage;
  put(text, kWordsPlace, words_of(data));
  put(text, kDataPlace, as_data(data));
  return text;
}

}  // namespace relock::reports
