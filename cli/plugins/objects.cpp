#include "cli/plugins/objects.h"

#include <fmt/format.h>

#include <exception>

#include "core/error.h"
#include "core/plugin_exchange.h"

namespace relock::plugin {
namespace {

/// What one call answers. The plug-in calls back from code that may be C: nothing is thrown through it.
class Answer {
 public:
  Answer() = default;
  Answer(const Answer&) = delete;
  Answer& operator=(const Answer&) = delete;

  const relock_answer* table() const { return &table_; }
  /// Throws Error if that is what it answered.
  void check() const {
    if (fault_) throw Error(*fault_);
  }

  Sightings sightings;
  std::vector<std::string> families;
  std::vector<Stage> stages;

 private:
  template <class Act>
  static void take(void* host, Act act) noexcept {
    auto& answer = *static_cast<Answer*>(host);
    try {
      act(answer);
    } catch (const std::exception& fault) {
      answer.fault_ = fault.what();
    }
  }

  std::optional<std::string> fault_;
  relock_answer table_{
      sizeof(relock_answer),
      this,
      [](void* host, const relock_sighting* seen) noexcept {
        take(host, [&](Answer& a) {
          if (!seen) throw Error("it answers with a sighting that is NULL");
          a.sightings.push_back(from_c(*seen));
        });
      },
      [](void* host, const char* family) noexcept {
        take(host, [&](Answer& a) { a.families.emplace_back(family ? family : ""); });
      },
      [](void* host, const char* sentence) noexcept {
        take(host, [&](Answer& a) { a.fault_ = sentence ? sentence : "it fails and does not say why"; });
      },
      [](void* host, const relock_stage* stage) noexcept {
        take(host, [&](Answer& a) {
          if (!stage) throw Error("it shows a stage that is NULL");
          a.stages.push_back(from_c(*stage));
        });
      }};
};

/// The options as the plug-in gets them; they point into `options`.
std::vector<relock_setting> settings_of(const Options& options) {
  std::vector<relock_setting> settings;
  for (const auto& [name, value] : options.values()) settings.push_back({name.c_str(), value.c_str()});
  return settings;
}

/// One object of the plug-in, destroyed by it.
class Object {
 public:
  Object(const relock_method& method, const Options& options, std::uint64_t seed) : method_(method) {
    const auto settings = settings_of(options);
    Answer answer;
    object_ = method.create(method.own, settings.data(), settings.size(), seed, answer.table());
    try {
      answer.check();
      if (!object_) throw Error(fmt::format("{} makes nothing and does not say why", method.name));
    } catch (...) {
      if (object_) method.destroy(object_);
      throw;
    }
  }
  ~Object() { method_.destroy(object_); }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  void* get() const { return object_; }
  const relock_method& method() const { return method_; }

 private:
  const relock_method& method_;
  void* object_ = nullptr;
};

/// Interface: Detector, or one that can more.
template <class Interface>
class DetectorOfPlugin : public Interface {
 public:
  explicit DetectorOfPlugin(std::unique_ptr<Object> object) : object_(std::move(object)) {}

  Sightings detect(const Image& image, const std::optional<Box>& where) override {
    const relock_image picture = to_c(image);
    const relock_box box = to_c(where.value_or(Box{}));
    Answer answer;
    object_->method().detect(object_->get(), &picture, where ? &box : nullptr, answer.table());
    answer.check();
    return std::move(answer.sightings);
  }

 protected:
  std::unique_ptr<Object> object_;
};

class ExplainingDetectorOfPlugin final : public DetectorOfPlugin<ExplainingDetector> {
 public:
  using DetectorOfPlugin::DetectorOfPlugin;

  std::vector<Stage> explain(const Image& image, const std::optional<Box>& where) override {
    const relock_image picture = to_c(image);
    const relock_box box = to_c(where.value_or(Box{}));
    Answer answer;
    object_->method().explain(object_->get(), &picture, where ? &box : nullptr, answer.table());
    answer.check();
    return std::move(answer.stages);
  }
};

bool shows_stages(const Object& object) {
  Answer answer;
  const bool shows = object.method().explain(object.get(), nullptr, nullptr, answer.table()) != 0;
  answer.check();
  return shows;
}

class PluginTracker final : public Tracker {
 public:
  PluginTracker(const relock_method& method, const Options& options, std::uint64_t seed)
      : object_(method, options, seed) {}

  void start(const Frame& frame, const Box& box) override {
    const relock_frame shown = to_c(frame);
    const relock_box given = to_c(box);
    Answer answer;
    object_.method().start(object_.get(), &shown, &given, answer.table());
    answer.check();
  }

  std::optional<Sighting> track(const Frame& frame) override {
    const relock_frame shown = to_c(frame);
    Answer answer;
    object_.method().track(object_.get(), &shown, answer.table());
    answer.check();
    if (answer.sightings.size() > 1)
      throw Error(fmt::format("{} says of one target that it is in {} places", object_.method().name,
                              answer.sightings.size()));
    return answer.sightings.empty() ? std::nullopt : std::optional(answer.sightings.front());
  }

  void expect(const Box& prior, double sigma_px) override {
    if (!object_.method().expect) return;
    const relock_box box = to_c(prior);
    Answer answer;
    object_.method().expect(object_.get(), &box, sigma_px, answer.table());
    answer.check();
  }

 private:
  Object object_;
};

}  // namespace

std::vector<std::string> families(const relock_method& method, const Options& options) {
  const auto settings = settings_of(options);
  Answer answer;
  method.reads(method.own, settings.data(), settings.size(), answer.table());
  answer.check();
  return std::move(answer.families);
}

std::unique_ptr<Detector> make_detector(const relock_method& method, const Options& options,
                                        std::uint64_t seed) {
  return std::make_unique<DetectorOfPlugin<Detector>>(std::make_unique<Object>(method, options, seed));
}

std::unique_ptr<Detector> make_explaining_detector(const relock_method& method, const Options& options,
                                                   std::uint64_t seed) {
  auto object = std::make_unique<Object>(method, options, seed);
  if (shows_stages(*object)) return std::make_unique<ExplainingDetectorOfPlugin>(std::move(object));
  return std::make_unique<DetectorOfPlugin<Detector>>(std::move(object));
}

std::unique_ptr<Tracker> make_tracker(const relock_method& method, const Options& options,
                                      std::uint64_t seed) {
  return std::make_unique<PluginTracker>(method, options, seed);
}

}  // namespace relock::plugin
