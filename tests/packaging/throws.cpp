// A plug-in that throws wherever it can: what it throws is told, nothing gets out.
#include <stdexcept>

#include "core/plugin.h"

class Throws final : public relock::Tracker {
 public:
  void start(const relock::Frame&, const relock::Box&) override {}
  std::optional<relock::Sighting> track(const relock::Frame& frame) override {
    if (frame.index > 10) throw 7;
    if (frame.index > 5) throw std::runtime_error("throws had enough of it");
    return relock::sighting_of(relock::Box{1, 2, 3, 4});
  }
};

#ifdef AT_LOAD
static const int thrown = (throw std::runtime_error("no reason"), 0);
#endif

RELOCK_PLUGIN("throws", plugin) {
#ifdef AT_FILL
  throw relock::Error("there is no such camera");
#endif
  plugin.tracker({.name = "throws",
                  .sentence = "throws after some frames",
                  .options = {{"count", "1", "", "of nothing"}},
                  .make = [](const relock::Options& given, std::uint64_t) {
                    given.whole("count", 0, 9);
                    if (given.whole("count", 0, 9) == 9) throw 9;
                    return std::make_unique<Throws>();
                  }});
}
