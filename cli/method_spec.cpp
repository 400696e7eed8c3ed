#include "cli/method_spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

constexpr int kDeepest = 8;

/// A recursive-descent reader of:  list = method {"," method};  method = word ["(" [argument {"," argument}] ")"];
/// argument = word "=" value | method. Only combinations have methods among their arguments.
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
    add_arguments(spec);
    return spec;
  }

  void add_arguments(MethodSpec& spec) {
    if (!take('(') || take(')')) return;
    if (++depth_ > kDeepest) fail(fmt::format("methods are nested at most {} deep", kDeepest));
    do {
      add_argument(spec);
    } while (take(','));
    if (!take(')')) fail("a closing parenthesis is missing");
    --depth_;
  }

  void add_argument(MethodSpec& spec) {
    const bool combines = is_combination(spec.name);
    const std::string name =
        word("(,)=", combines ? "a method or an option belongs here" : "an option's name belongs here");
    if (take('=')) {
      if (!spec.options.emplace(name, word("(,)", "a value belongs here")).second)
        fail(fmt::format("option {} is given twice", name));
      return;
    }
    if (!combines) fail(no_combination(spec.name));
    if (!spec.options.empty()) fail("methods come before options");
    spec.parts.push_back({name});
    add_arguments(spec.parts.back());
  }

  static std::string no_combination(const std::string& name) {
    const std::string meant = nearest_name(name, combination_names());
    return fmt::format("an option is written name=value, and {} takes no methods{}; {} do", name,
                       meant.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", meant),
                       fmt::join(combination_names(), ", "));
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
  int depth_ = 0;
};

}  // namespace

std::string MethodSpec::text() const {
  std::vector<std::string> inside;
  for (const MethodSpec& part : parts) inside.push_back(part.text());
  for (const auto& [option, value] : options) inside.push_back(option + "=" + value);
  return inside.empty() ? name : fmt::format("{}({})", name, fmt::join(inside, ","));
}

const std::vector<std::string>& combination_names() {
  static const std::vector<std::string> names{"detect",  "track",     "hybrid",
                                              "guarded", "gap-aware", "blur-predict"};
  return names;
}

bool is_combination(std::string_view name) {
  const auto& names = combination_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<MethodSpec> parse_methods(std::string_view text) { return SpecReader(text).read(); }

}  // namespace relock
