#include <fmt/format.h>

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <future>
#include <memory>

#include "cli/conformance/checks.h"
#include "core/random.h"

namespace relock {
namespace {

constexpr std::uint64_t kSeed = 1;

void only_if_deterministic(const Subject& subject) {
  if (!subject.deterministic()) throw NotAsked("its entry says that its answers differ from run to run");
}

/// A process in which things have gone on before: numbers were drawn, memory is used and not clean, and some
/// time has passed.
void disturb_the_process() {
  std::srand(1234567);
  std::vector<std::unique_ptr<std::vector<std::uint8_t>>> used;
  for (std::size_t bytes = 16; bytes < 4'000'000; bytes = bytes * 3 / 2)
    for (int i = 0; i < 4; ++i) used.push_back(std::make_unique<std::vector<std::uint8_t>>(bytes, 0xA5));
  usleep(20'000);
}

Note repeats(const Subject& subject, const MemoryLimits&, Stage& stage) {
  only_if_deterministic(subject);
  if (stage.is_second()) disturb_the_process();
  const Stand stand = usual_stand(subject);
  const Film film = moving(stand.scene, stand.start, {3, 1}, 8);
  const auto one = stage.call([&] { return session(subject, kSeed); });
  for (std::size_t i = 0; i < film.shots.size(); ++i) {
    const Shot& shot = film.shots[i];
    stage.at(place_of(shot));
    if (subject.tracker && i == 0)
      stage.call([&] { one->start(shot.frame(), film.start); });
    else
      stage.answered(text_of(stage.call([&] { return one->see(shot.frame()); })));
  }
  return {};
}

/// A session and what it is shown. `step` shows the next frame.
class Work {
 public:
  Work(const Subject& subject, const Film& film, const Stage& stage) : film_(film), stage_(stage) {
    session_ = stage.call([&] { return session(subject, kSeed); });
    starts_ = subject.tracker != nullptr;
  }

  bool step() {
    const Frame frame = film_.shots[next_].frame();
    if (starts_ && next_ == 0)
      stage_.call([&] { session_->start(frame, film_.start); });
    else
      answers.push_back(text_of(stage_.call([&] { return session_->see(frame); })));
    return ++next_ < film_.shots.size();
  }
  std::vector<std::string> all() {
    while (step()) {
    }
    return answers;
  }

  std::vector<std::string> answers;

 private:
  const Film& film_;
  const Stage& stage_;
  std::unique_ptr<Session> session_;
  bool starts_ = true;
  std::size_t next_ = 0;
};

/// Two films that have little in common.
std::pair<Film, Film> two_films(const Subject& subject) {
  const Stand stand = usual_stand(subject);
  Box elsewhere = stand.start;
  elsewhere.x += 60, elsewhere.y += 14;
  Film other = moving(stand.scene, elsewhere, {-3, 1}, 6);
  for (Shot& shot : other.shots) shot.index += 100, shot.captured += std::chrono::seconds(20);
  return {moving(stand.scene, stand.start, {3, 1}, 6), other};
}

void must_be_equal(const Subject& subject, const std::vector<std::string>& alone,
                   const std::vector<std::string>& beside, const Stage& stage) {
  if (!subject.deterministic()) return;  // that neither crashed is all that can be said
  for (std::size_t i = 0; i < alone.size(); ++i)
    if (alone[i] != beside[i])
      stage.fail(fmt::format("answer {}: {}, and {} when it worked alone", i + 1, beside[i], alone[i]));
}

Note beside(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const auto [first, second] = two_films(subject);
  stage.at("an object at work alone");
  const auto first_alone = Work(subject, first, stage).all();
  stage.at("a second object, after the first");
  const auto second_alone = Work(subject, second, stage).all();
  stage.at("two objects at work by turns");
  Work a(subject, first, stage), b(subject, second, stage);
  bool more = true;
  while (more) {
    more = a.step();
    more = b.step() && more;
  }
  must_be_equal(subject, first_alone, a.answers, stage);
  must_be_equal(subject, second_alone, b.answers, stage);
  return subject.deterministic() ? Note{} : Note("answers not compared: they differ from run to run");
}

Note threads(const Subject& subject, const MemoryLimits&, Stage& stage) {
  const auto [first, second] = two_films(subject);
  stage.at("an object at work alone");
  const auto first_alone = Work(subject, first, stage).all();
  const auto second_alone = Work(subject, second, stage).all();
  for (int round = 0; round < 3; ++round) {
    stage.at("two objects at work on two threads");
    const auto work = [&](const Film& film) { return Work(subject, film, stage).all(); };
    auto a = std::async(std::launch::async, work, std::cref(first));
    auto b = std::async(std::launch::async, work, std::cref(second));
    const auto first_beside = a.get(), second_beside = b.get();
    must_be_equal(subject, first_alone, first_beside, stage);
    must_be_equal(subject, second_alone, second_beside, stage);
  }
  return subject.deterministic() ? Note{} : Note("answers not compared: they differ from run to run");
}

/// What the process has: bytes in memory, and bytes that were allocated and not yet freed.
struct Use {
  double resident = 0, allocated = 0;
};

Use use_now() {
  Use use;
  double total = 0;
  std::ifstream("/proc/self/statm") >> total >> use.resident;
  use.resident *= static_cast<double>(sysconf(_SC_PAGESIZE));
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const auto heap = mallinfo2();
  use.allocated = static_cast<double>(heap.uordblks) + static_cast<double>(heap.hblkhd);
#endif
  return use;
}

std::string grown(double bytes, int frames) {
  return fmt::format("{:.1f} MB ({:.0f} bytes a frame)", bytes / 1e6, bytes / frames);
}

/// What is kept may differ from frame to frame, so the least of a few frames counts.
Use least(const Use& a, const Use& b) {
  return {std::min(a.resident, b.resident), std::min(a.allocated, b.allocated)};
}

Note memory(const Subject& subject, const MemoryLimits& limits, Stage& stage) {
  constexpr double kMostResident = 4e6, kMostAllocated = 256e3;
  constexpr int kWindow = 8, kWarmFrames = 200, kFewest = 100, kTelling = 1000;
  using Clock = std::chrono::steady_clock;
  const Stand stand = small_stand(subject);
  const Film film = moving(stand.scene, stand.start, {0, 0}, 1);
  const auto one = stage.call([&] { return session(subject, kSeed); });
  stage.at("start");
  stage.call([&] { one->start(film.shots[0].frame(), film.start); });
  std::vector<Use> uses;
  uses.reserve(static_cast<std::size_t>(limits.frames));
  const auto begun = Clock::now();
  int shown = 0;
  while (shown < limits.frames && (shown < kFewest || Clock::now() - begun < limits.budget)) {
    Frame frame = film.shots[1].frame();
    frame.index = ++shown;
    frame.captured = shown * period_of(30) + Time{};
    stage.at(fmt::format("frame {}", shown));
    stage.call([&] { one->see(frame); });
    uses.push_back(use_now());
  }
  const auto around = [&](int last) {
    Use use = uses[static_cast<std::size_t>(last - 1)];
    for (int i = std::max(0, last - kWindow); i < last; ++i)
      use = least(use, uses[static_cast<std::size_t>(i)]);
    return use;
  };
  // The first frames fill what is kept for good: of a short film up to a half.
  const int warm = std::max({kWindow, shown / 5, std::min(shown / 2, kWarmFrames)});
  const Use before = around(warm), after = around(shown);
  const auto budget_s = std::chrono::duration<double>(limits.budget).count();
  const bool cut = shown < limits.frames;
  const auto too_much = [&](const char* what, double more) {
    if (cut && shown < kTelling)
      throw NotAsked(
          fmt::format("{} grew over the {} frames of a {:g} s budget, which may be warming up: give "
                      "it a longer --budget",
                      what, shown, budget_s));
    stage.fail(fmt::format("{} grew by {}", what, grown(more, shown - warm)));
  };
  stage.at(fmt::format("from frame {} to frame {} of a picture that stays the same", warm, shown));
  if (const double more = after.allocated - before.allocated; more > kMostAllocated)
    too_much("what it has allocated", more);
  if (const double more = after.resident - before.resident; more > kMostResident)
    too_much("its memory", more);
  return fmt::format("flat over {} frames{}", shown, cut ? fmt::format(" ({:g} s budget)", budget_s) : "");
}

}  // namespace

std::vector<Check> session_checks() {
  return {{"repeats", repeats, true}, {"beside", beside}, {"threads", threads}, {"memory", memory}};
}

}  // namespace relock
