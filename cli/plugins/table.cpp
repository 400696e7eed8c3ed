#include "cli/plugins/table.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstring>
#include <set>

#include "cli/plugins/objects.h"
#include "core/error.h"

namespace relock {
namespace {

constexpr std::uint64_t kMany = 1000;        // more methods or options than this are a slip
constexpr std::size_t kLongest = 4096;       // likewise texts
constexpr std::uint32_t kLargest = 1 << 16;  // likewise structs
// relock_method as it was at first; `explain` came later.
constexpr std::size_t kFirstMethod = offsetof(relock_method, explain);

bool struct_fits(std::uint32_t size, std::size_t least) {
  return size >= least && size <= kLargest && size % alignof(void*) == 0;
}

void check_version(const relock_plugin* table) {
  if (!table || table->abi != RELOCK_PLUGIN_ABI)
    throw Error(
        fmt::format("it speaks {} of the plug-in interface, not {}; build it with this relock's headers",
                    table ? fmt::format("version {}", table->abi) : "another version", RELOCK_PLUGIN_ABI));
  if (!struct_fits(table->size, sizeof(relock_plugin)) || !struct_fits(table->method_size, kFirstMethod) ||
      !struct_fits(table->option_size, sizeof(relock_option)))
    throw Error(
        fmt::format("its structs are of {}, {} and {} bytes, not {}, {} and {}; build it with this "
                    "relock's headers",
                    table->size, table->method_size, table->option_size, sizeof(relock_plugin),
                    sizeof(relock_method), sizeof(relock_option)));
  if (table->error) throw Error(fmt::format("it cannot serve here: {}", table->error));
}

/// A text of the plug-in: there, of one line, and of a length that a text has.
std::string text(const char* given, const std::string& what) {
  if (!given) throw Error(fmt::format("{} is missing (NULL)", what));
  const std::string found(given, strnlen(given, kLongest));
  if (found.size() == kLongest) throw Error(fmt::format("{} does not end", what));
  for (const char c : found)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      throw Error(fmt::format("{} holds a control character", what));
  return found;
}

/// A name that can be typed where methods are asked for.
std::string name(const char* given, const std::string& what) {
  const std::string found = text(given, what);
  const bool legal = !found.empty() && found.size() <= 64 &&
                     found.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                         "0123456789_-.+") == std::string::npos;
  if (!legal) throw Error(fmt::format("{} is \"{}\"; it must be of letters, digits, _ - . +", what, found));
  return found;
}

/// The n-th of structs that lie `stride` bytes apart.
template <class Struct>
const Struct& nth(const Struct* first, std::uint64_t n, std::uint32_t stride) {
  return *reinterpret_cast<const Struct*>(reinterpret_cast<const char*>(first) + n * stride);
}

template <class Struct>
void check_count(const Struct* first, std::uint64_t count, const std::string& what) {
  if (count > kMany) throw Error(fmt::format("{} are {} by count, which cannot be", what, count));
  if (count > 0 && !first) throw Error(fmt::format("{} are {} by count, but the list is NULL", what, count));
}

std::vector<OptionInfo> options_of(const relock_method& method, const std::string& owner,
                                   std::uint32_t stride) {
  check_count(method.options, method.option_count, "the options of " + owner);
  std::vector<OptionInfo> options;
  std::set<std::string> names;
  for (std::uint64_t i = 0; i < method.option_count; ++i) {
    const relock_option& option = nth(method.options, i, stride);
    const std::string own = name(option.name, fmt::format("the name of option {} of {}", i + 1, owner));
    const std::string what = fmt::format("of option {} of {}", own, owner);
    if (!names.insert(own).second) throw Error(fmt::format("{} lists option {} twice", owner, own));
    const std::string value = text(option.default_value, "the default " + what);
    if (value.find_first_of("(,)") != std::string::npos)
      throw Error(fmt::format("the default {} is \"{}\", which cannot be typed", what, value));
    options.push_back(
        {own, value, text(option.unit, "the unit " + what), text(option.sentence, "the sentence " + what)});
  }
  return options;
}

void check_functions(const relock_method& m, const std::string& name) {
  const bool tracker = m.kind == RELOCK_TRACKER;
  if (m.kind != RELOCK_DETECTOR && !tracker)
    throw Error(fmt::format("{} is of kind {}, neither a detector nor a tracker", name, m.kind));
  const char* missing = !m.create               ? "create"
                        : !m.destroy            ? "destroy"
                        : !tracker && !m.detect ? "detect"
                        : tracker && !m.start   ? "start"
                        : tracker && !m.track   ? "track"
                                                : nullptr;
  if (missing) throw Error(fmt::format("{} has no function {}", name, missing));
}

DetectorEntry detector_of(const relock_method& m, std::uint32_t method_size) {
  DetectorEntry entry;
  const bool explains = method_size >= kFirstMethod + sizeof m.explain && m.explain;
  if (m.reads) entry.reads = [&m](const Options& options) { return plugin::families(m, options); };
  const auto make = explains ? &plugin::make_explaining_detector : &plugin::make_detector;
  entry.make = [&m, make](const Options& options, std::uint64_t seed) { return make(m, options, seed); };
  return entry;
}

TrackerEntry tracker_of(const relock_method& m) {
  TrackerEntry entry;
  entry.deterministic = (m.flags & RELOCK_NOT_DETERMINISTIC) == 0;
  entry.honours_expect = (m.flags & RELOCK_HONOURS_EXPECT) != 0;
  entry.make = [&m](const Options& options, std::uint64_t seed) {
    return plugin::make_tracker(m, options, seed);
  };
  return entry;
}

}  // namespace

Methods methods_of(const relock_plugin* table, const PluginFile& file) {
  check_version(table);
  name(table->name, "its name");
  check_count(table->methods, table->method_count, "its methods");
  if (table->method_count == 0) throw Error("it brings no method");
  Methods methods;
  for (std::uint64_t i = 0; i < table->method_count; ++i) {
    const relock_method& m = nth(table->methods, i, table->method_size);
    const std::string own = name(m.name, fmt::format("the name of method {}", i + 1));
    check_functions(m, own);
    const auto add = [&](auto& registry, auto entry) {
      entry.name = own;
      entry.sentence = text(m.sentence, "the sentence of " + own);
      entry.options = options_of(m, own, table->option_size);
      entry.plugin = file;
      registry.add(std::move(entry));
    };
    if (m.kind == RELOCK_DETECTOR) {
      add(methods.detectors, detector_of(m, table->method_size));
    } else {
      add(methods.trackers, tracker_of(m));
    }
  }
  return methods;
}

}  // namespace relock
