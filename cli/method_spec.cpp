#include "cli/method_spec.h"

#include <fmt/format.h>

#include "core/error.h"

namespace relock {
namespace {

/// A recursive-descent reader of:  list = method {"," method};  method = word ["(" [pair {"," pair}] ")"];
/// pair = word "=" value.
class SpecReader {
 public:
  explicit SpecReader(std::string_view text) : text_(text) {}

  std::vector<MethodSpec> read() {
    std::vector<MethodSpec> all;
    do {
      all.push_back(method());
    } while (take(','));
    if (at_ < text_.size()) fail("a comma belongs between two methods");
    return all;
  }

 private:
  MethodSpec method() {
    MethodSpec spec;
    spec.name = word("(,)=", "a method's name belongs here");
    if (!take('(')) return spec;
    if (take(')')) return spec;
    do {
      const std::string option = word("(,)=", "an option's name belongs here");
      if (!take('=')) fail("an option is written name=value");
      if (!spec.options.emplace(option, word("(,)", "a value belongs here")).second)
        fail(fmt::format("option {} is given twice", option));
    } while (take(','));
    if (!take(')')) fail("a closing parenthesis is missing");
    return spec;
  }

  std::string word(std::string_view ends, std::string_view wanted) {
    skip_spaces();
    std::size_t end = at_;
    while (end < text_.size() && ends.find(text_[end]) == std::string_view::npos) ++end;
    std::size_t last = end;
    while (last > at_ && text_[last - 1] == ' ') --last;
    if (last == at_) fail(wanted);
    const std::string found(text_.substr(at_, last - at_));
    at_ = end;
    return found;
  }

  bool take(char wanted) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }

  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  [[noreturn]] void fail(std::string_view sentence) const {
    throw Error(
        fmt::format("methods, character {}: {}\n  {}\n  {:>{}}", at_ + 1, sentence, text_, '^', at_ + 1));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::string MethodSpec::text() const {
  if (options.empty()) return name;
  std::string inside;
  for (const auto& [option, value] : options) inside += (inside.empty() ? "" : ",") + option + "=" + value;
  return fmt::format("{}({})", name, inside);
}

std::vector<MethodSpec> parse_methods(std::string_view text) { return SpecReader(text).read(); }

}  // namespace relock
