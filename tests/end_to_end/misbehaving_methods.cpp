// A relock with methods that do what methods must not do, for survival_test.sh. Each answers as told by the
// yardstick "still" would until frame `at`.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <thread>

#include "cli/program.h"

namespace {

enum class Deed { crash, leave, hang, eat, throw_odd };

class Misbehaving final : public relock::Tracker {
 public:
  Misbehaving(Deed deed, int at) : deed_(deed), at_(at) {}

  void start(const relock::Frame&, const relock::Box& box) override { box_ = box; }

  std::optional<relock::Sighting> track(const relock::Frame& frame) override {
    if (frame.index >= at_) misbehave();
    return relock::sighting_of(box_);
  }

 private:
  void misbehave() {
    switch (deed_) {
      case Deed::crash:
        std::fputs("about to fall over\n", stderr);
        std::raise(SIGSEGV);
        break;
      case Deed::leave:
        _exit(0);
      case Deed::hang:
        while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
      case Deed::eat:
        while (true) eaten_.emplace_back(10'000'000, 'x');
      case Deed::throw_odd:
        throw 7;  // NOLINT: that is the point
    }
  }

  Deed deed_;
  int at_;
  relock::Box box_;
  std::vector<std::string> eaten_;
};

}  // namespace

int main(int argc, char** argv) {
  auto methods = relock::builtin_methods();
  const auto add = [&](const char* name, Deed deed) {
    methods.trackers.add({.name = name,
                          .sentence = "misbehaves",
                          .options = {{"at", "20", "frame", "when"}},
                          .make = [deed](const relock::Options& given, std::uint64_t) {
                            return std::make_unique<Misbehaving>(deed, given.whole("at", 0, 1000));
                          }});
  };
  add("crash", Deed::crash);
  add("leave", Deed::leave);
  add("hang", Deed::hang);
  add("eat", Deed::eat);
  add("throw-odd", Deed::throw_odd);
  return relock::run_program(argc, argv, methods);
}
