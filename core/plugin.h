#pragma once

#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/entry.h"
#include "core/plugin_abi.h"
#include "core/plugin_exchange.h"

// For the author of a plug-in in C++: a detector or a tracker in a shared library, which relock loads with
// --plugin. Nothing of relock is linked; link CMake's relock::plugin, which says how a plug-in is compiled.
// docs/adding-a-detector.md and docs/adding-a-tracker.md show whole ones.
//
//   class Glint final : public relock::Detector { … };
//
//   RELOCK_PLUGIN("glint", plugin) {
//     plugin.detector({.name = "glint",
//                      .sentence = "the brightest blob",
//                      .options = {{"depth", "30", "grey levels", "how much darker it may be"}},
//                      .make = [](const relock::Options& given, std::uint64_t) {
//                        return std::make_unique<Glint>(given.number("depth", 0, 255));
//                      }});
//   }
//
// Exceptions of the class are caught and told to relock as what they say. A class that is an ExplainingDetector
// (core/stage.h) shows its stages to `relock detect --explain`.

namespace relock {

/// What a plug-in brings: fill it in RELOCK_PLUGIN.
class Plugin {
 public:
  /// Adds a detector.
  void detector(DetectorEntry entry) { methods_.push_back({std::move(entry), {}}); }
  /// Adds a tracker.
  void tracker(TrackerEntry entry) { methods_.push_back({std::move(entry), {}}); }

  /// The table for `fill`'s plug-in. Made once, for RELOCK_PLUGIN.
  Plugin(const char* name, void (*fill)(Plugin&)) noexcept;
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;
  const relock_plugin* table() const { return &table_; }

 private:
  struct Method {
    std::variant<DetectorEntry, TrackerEntry> entry;
    std::vector<relock_option> options;  // point into the entry
  };

  static void describe(Method& method, relock_method& table);

  std::deque<Method> methods_;  // a deque: what the table points to does not move
  std::vector<relock_method> method_tables_;
  std::string error_;
  relock_plugin table_{};
};

namespace plugin {

/// Does what is asked, and tells relock of the exception that comes out of it, if any.
template <class Act>
void answer_for(const relock_answer* answer, Act act) noexcept {
  try {
    act();
  } catch (const std::exception& fault) {
    answer->error(answer->host, fault.what());
  } catch (...) {
    answer->error(answer->host, "it threw something that is no exception");
  }
}

inline Options options_from_c(const std::string& owner, const relock_setting* settings, std::uint64_t count) {
  std::map<std::string, std::string> values;
  for (std::uint64_t i = 0; i < count; ++i) values[settings[i].name] = settings[i].value;
  return Options(owner, std::move(values));
}

template <class Entry>
void* create(void* own, const relock_setting* settings, std::uint64_t count, std::uint64_t seed,
             const relock_answer* answer) noexcept {
  void* object = nullptr;
  answer_for(answer, [&] {
    const auto& entry = *static_cast<const Entry*>(own);
    object = entry.make(options_from_c(entry.name, settings, count), seed).release();
  });
  return object;
}

template <class Interface>
void destroy(void* object) noexcept {
  delete static_cast<Interface*>(object);
}

inline void reads(void* own, const relock_setting* settings, std::uint64_t count,
                  const relock_answer* answer) noexcept {
  answer_for(answer, [&] {
    const auto& entry = *static_cast<const DetectorEntry*>(own);
    for (const std::string& family : entry.reads(options_from_c(entry.name, settings, count)))
      answer->code_family(answer->host, family.c_str());
  });
}

inline void detect(void* object, const relock_image* image, const relock_box* where,
                   const relock_answer* answer) noexcept {
  answer_for(answer, [&] {
    const auto box = where ? std::optional(from_c(*where)) : std::nullopt;
    for (const Sighting& sighting : static_cast<Detector*>(object)->detect(from_c(*image), box)) {
      const relock_sighting seen = to_c(sighting);
      answer->sighting(answer->host, &seen);
    }
  });
}

inline int explain(void* object, const relock_image* image, const relock_box* where,
                   const relock_answer* answer) noexcept {
  auto* detector = dynamic_cast<ExplainingDetector*>(static_cast<Detector*>(object));
  if (detector == nullptr) return 0;
  if (image == nullptr) return 1;
  answer_for(answer, [&] {
    const auto box = where ? std::optional(from_c(*where)) : std::nullopt;
    for (const Stage& stage : detector->explain(from_c(*image), box)) {
      const StageForC shown = to_c(stage);
      answer->stage(answer->host, &shown.stage);
    }
  });
  return 1;
}

inline void start(void* object, const relock_frame* frame, const relock_box* box,
                  const relock_answer* answer) noexcept {
  answer_for(answer, [&] { static_cast<Tracker*>(object)->start(from_c(*frame), from_c(*box)); });
}

inline void track(void* object, const relock_frame* frame, const relock_answer* answer) noexcept {
  answer_for(answer, [&] {
    if (const auto sighting = static_cast<Tracker*>(object)->track(from_c(*frame))) {
      const relock_sighting seen = to_c(*sighting);
      answer->sighting(answer->host, &seen);
    }
  });
}

inline void expect(void* object, const relock_box* prior, double sigma_px,
                   const relock_answer* answer) noexcept {
  answer_for(answer, [&] { static_cast<Tracker*>(object)->expect(from_c(*prior), sigma_px); });
}

inline void describe_calls(DetectorEntry& entry, relock_method& table) {
  table.kind = RELOCK_DETECTOR;
  table.own = &entry;
  table.reads = &reads;
  table.create = &create<DetectorEntry>;
  table.destroy = &destroy<Detector>;
  table.detect = &detect;
  table.explain = &explain;
}

inline void describe_calls(TrackerEntry& entry, relock_method& table) {
  table.kind = RELOCK_TRACKER;
  table.flags = (entry.deterministic ? 0u : static_cast<std::uint32_t>(RELOCK_NOT_DETERMINISTIC)) |
                (entry.honours_expect ? static_cast<std::uint32_t>(RELOCK_HONOURS_EXPECT) : 0u);
  table.own = &entry;
  table.create = &create<TrackerEntry>;
  table.destroy = &destroy<Tracker>;
  table.start = &start;
  table.track = &track;
  table.expect = &expect;
}

}  // namespace plugin

inline void Plugin::describe(Method& method, relock_method& table) {
  std::visit(
      [&](auto& entry) {
        for (const OptionInfo& o : entry.options)
          method.options.push_back(
              {o.name.c_str(), o.default_value.c_str(), o.unit.c_str(), o.sentence.c_str()});
        table.name = entry.name.c_str();
        table.sentence = entry.sentence.c_str();
        plugin::describe_calls(entry, table);
      },
      method.entry);
  table.options = method.options.data();
  table.option_count = method.options.size();
}

inline Plugin::Plugin(const char* name, void (*fill)(Plugin&)) noexcept {
  table_.abi = RELOCK_PLUGIN_ABI;
  table_.size = sizeof(relock_plugin);
  table_.method_size = sizeof(relock_method);
  table_.option_size = sizeof(relock_option);
  table_.name = name;
  try {
    fill(*this);
    method_tables_.resize(methods_.size());
    for (std::size_t i = 0; i < methods_.size(); ++i) describe(methods_[i], method_tables_[i]);
  } catch (const std::exception& fault) {
    error_ = fault.what();
    table_.error = error_.c_str();
  } catch (...) {
    table_.error = "it threw something that is no exception";
  }
  table_.methods = method_tables_.data();
  table_.method_count = table_.error ? 0 : method_tables_.size();
}

}  // namespace relock

/// The plug-in's registration: RELOCK_PLUGIN("its name", plugin) { plugin.detector({…}); }
#define RELOCK_PLUGIN(name, plugin)                              \
  static void relock_fill_plugin(relock::Plugin& plugin);        \
  const relock_plugin* relock_plugin_v1(std::uint32_t abi) {     \
    if (abi != RELOCK_PLUGIN_ABI) return nullptr;                \
    static const relock::Plugin made(name, &relock_fill_plugin); \
    return made.table();                                         \
  }                                                              \
  static void relock_fill_plugin(relock::Plugin& plugin)
