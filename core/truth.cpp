#include "core/truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"

namespace relock {
namespace {

constexpr std::string_view kDetector = "detector ";
constexpr std::string_view kSpline = "spline";

/// The names in a list that is separated by '+', sorted. Throws Error on an empty one.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    names.emplace_back(text.substr(begin, end - begin));
    if (names.back().empty()) throw Error("a label's source is \"detector\" without a name");
    begin = end + 1;
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool in_a_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; }

}  // namespace

std::string_view to_string(Label label) {
  switch (label) {
    case Label::visible:
      return "visible";
    case Label::absent:
      return "absent";
    case Label::unlabelled:
      break;
  }
  return "unlabelled";
}

std::string to_string(const LabelSource& source) {
  const std::string names =
      source.detectors.empty() ? "" : fmt::format("{}{}", kDetector, fmt::join(source.detectors, "+"));
  switch (source.kind) {
    case LabelSource::Kind::hand:
      return "hand";
    case LabelSource::Kind::spline:
      return names.empty() ? std::string(kSpline) : fmt::format("{} {}", kSpline, names);
    case LabelSource::Kind::detector:
      return names;
    case LabelSource::Kind::unstated:
      break;
  }
  return "";
}

LabelSource parse_label_source(std::string_view text) {
  if (text.empty()) return {};
  if (text == "hand") return {LabelSource::Kind::hand};
  if (text == kSpline) return {LabelSource::Kind::spline};
  const bool spline =
      text.starts_with(kSpline) && text.size() > kSpline.size() && text[kSpline.size()] == ' ';
  const std::string_view rest = spline ? text.substr(kSpline.size() + 1) : text;
  if (rest.starts_with(kDetector))
    return {spline ? LabelSource::Kind::spline : LabelSource::Kind::detector,
            names_in(rest.substr(kDetector.size()))};
  throw Error(fmt::format("\"{}\" is none of hand, spline, detector NAME, spline detector NAME", text));
}

bool stems_from(const LabelSource& source, std::string_view method) {
  for (const std::string& name : source.detectors) {
    for (std::size_t at = method.find(name); at != std::string_view::npos; at = method.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      const bool whole =
          (at == 0 || !in_a_name(method[at - 1])) && (end == method.size() || !in_a_name(method[end]));
      if (whole) return true;
    }
  }
  return false;
}

}  // namespace relock
