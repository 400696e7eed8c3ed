// Methods that break one promise each are caught by the check that asks for it, and by no other.
#include "cli/conformance/conformance.h"

#include <gtest/gtest.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <set>
#include <thread>

#include "core/error.h"
#include "trackers/yardsticks.h"

namespace relock {
namespace {

ConformanceOptions quick() {
  ConformanceOptions options;
  options.frames = 300;
  options.silence = std::chrono::seconds(2);
  return options;
}

std::set<std::string> failures(const Conformance& conformance) {
  std::set<std::string> names;
  for (const CheckResult& check : conformance.checks)
    if (check.kind == CheckResult::Kind::failed) names.insert(check.check);
  return names;
}

std::string reason(const Conformance& conformance, const std::string& name) {
  for (const CheckResult& check : conformance.checks)
    if (check.check == name) return check.reason;
  return "no such check";
}

/// A tracker that keeps every promise: the base of those that do not.
class Good : public Tracker {
 public:
  void start(const Frame& frame, const Box& box) override { inner_->start(frame, box); }
  std::optional<Sighting> track(const Frame& frame) override { return inner_->track(frame); }

 private:
  std::unique_ptr<Tracker> inner_ =
      linear_tracker(linear_options(Options("linear", linear_option_list(), {})));
};

class WritesIntoThePicture final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    auto* pixel = const_cast<volatile std::uint8_t*>(frame.image.row(frame.image.size().height / 2));
    *pixel = *pixel;
    return answer;
  }
};

class ReadsBehindTheLastRow final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    const Size size = frame.image.size();
    const volatile std::uint8_t* last = frame.image.row(size.height - 1);
    (void)last[size.width * channels(frame.image.format())];
    return answer;
  }
};

class LooksBetweenTheRows final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    const std::size_t behind_first =
        static_cast<std::size_t>(frame.image.size().width * channels(frame.image.format()));
    if (answer) answer->confidence = frame.image.row(0)[behind_first] / 255.0;
    return answer;
  }
};

class KeepsTheLastFrame final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    if (!last_.empty()) (void)*static_cast<const volatile std::uint8_t*>(last_.row(0));
    last_ = frame.image;
    return answer;
  }
  Image last_;
};

class SaysNanOfABlackPicture final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    const std::uint8_t* row = frame.image.row(0);
    if (answer && row[0] + row[1] + row[2] == 0)
      answer->outline = Box{std::numeric_limits<double>::quiet_NaN(), 1, 1, 1};
    return answer;
  }
};

class Leaks final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    kept_.push_back(std::vector<char>(4096, 'x'));
    return Good::track(frame);
  }
  std::vector<std::vector<char>> kept_;
};

class HangsAfterALongGap final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    if (frame.captured - last_ > std::chrono::seconds(4) && last_ != Time{}) pause();
    last_ = frame.captured;
    return Good::track(frame);
  }
  Time last_;
};

class CrashesOnNan final : public Good {
  void start(const Frame& frame, const Box& box) override {
    if (box.x != box.x) std::raise(SIGSEGV);
    Good::start(frame, box);
  }
};

class AbortsOnAHint final : public Good {
  void expect(const Box& prior, double) override {
    if (!well_formed(prior)) fmt::print(stderr, "assertion failed: prior\n"), std::abort();
  }
};

class SharesItsState final : public Good {
  void start(const Frame& frame, const Box& box) override {
    Good::start(frame, box);
    size = box.width + box.x;
  }
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    if (answer) answer->confidence = size / 1000;
    return answer;
  }
  static inline std::atomic<double> size{0};
};

class SharesABuffer final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    if (!answer) return answer;
    buffer = answer->centre.x;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    answer->confidence = std::clamp(buffer / 1000, 0.0, 1.0);
    return answer;
  }
  static inline std::atomic<double> buffer{0};
};

class DiffersFromRunToRun final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    if (answer) answer->confidence = 1.0 / (1 + getpid());
    return answer;
  }
};

class FollowsOutOfThePicture final : public Good {
  std::optional<Sighting> track(const Frame& frame) override {
    auto answer = Good::track(frame);
    if (answer) last_ = bounds(answer->outline);
    if (!answer && last_.x < 0 && last_.x > -100) return sighting_of(Box{-100, last_.y, 32, 28});
    return answer;
  }
  Box last_;
};

class EatsMemory final : public Good {
  void start(const Frame& frame, const Box& box) override {
    if (box.width > 1e9) memory_.resize(std::size_t{8} << 30);
    Good::start(frame, box);
  }
  std::vector<char> memory_;
};

class RefusesSmallBoxes final : public Good {
  void start(const Frame& frame, const Box& box) override {
    if (box.width < 11) throw Error("the box is too small");
    Good::start(frame, box);
  }
};

class ThrowsNoErrors final : public Good {
  void start(const Frame& frame, const Box& box) override {
    if (started_) throw std::logic_error("twice");
    Good::start(frame, box);
    started_ = true;
  }
  bool started_ = false;
};

class RefusesAnotherFormat final : public Good {
  void start(const Frame& frame, const Box& box) override {
    Good::start(frame, box);
    format_ = frame.image.format();
  }
  std::optional<Sighting> track(const Frame& frame) override {
    if (!frame.image.empty() && frame.image.format() != format_) throw Error("another format");
    return Good::track(frame);
  }
  PixelFormat format_ = PixelFormat::bgr8;
};

class StaysAtTheStart final : public Good {
  void start(const Frame& frame, const Box& box) override { Good::start(frame, box), box_ = box; }
  std::optional<Sighting> track(const Frame& frame) override {
    Good::track(frame);
    return sighting_of(box_);
  }
  Box box_;
};

struct Case {
  std::string name;
  std::function<std::unique_ptr<Tracker>()> make;
  std::set<std::string> caught_by;
  std::string reason;                 ///< a part of it
  std::set<std::string> sometimes{};  ///< checks that may catch it too: two threads may miss each other
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

template <class Bad>
Case bad(const std::string& name, const std::set<std::string>& caught_by, const std::string& why,
         const std::set<std::string>& sometimes = {}) {
  return {name, [] { return std::make_unique<Bad>(); }, caught_by, why, sometimes};
}

std::vector<Case> cases() {
  return {
      bad<WritesIntoThePicture>("WritesIntoThePicture", {"writes"},
                                "frame 1: writes into the picture it is given"),
      bad<ReadsBehindTheLastRow>("ReadsBehindTheLastRow", {"rows"}, "reads outside of the picture's rows"),
      bad<LooksBetweenTheRows>("LooksBetweenTheRows", {"rows"}, "the bytes between the rows"),
      bad<KeepsTheLastFrame>("KeepsTheLastFrame", {"keeps"}, "frame 2: reads the pixels of an earlier frame"),
      bad<SaysNanOfABlackPicture>("SaysNanOfABlackPicture", {"blank"},
                                  "frame 3 (a black picture): gave an answer that is none"),
      bad<Leaks>("Leaks", {"memory"}, "what it has allocated grew by"),
      bad<HangsAfterALongGap>("HangsAfterALongGap", {"gaps"}, "gave no answer for 2 s"),
      bad<CrashesOnNan>("CrashesOnNan", {"refuses"},
                        "start on a box without a place (x nan, y 40, 32 x 28 px): was killed by signal 11"),
      bad<AbortsOnAHint>("AbortsOnAHint", {"hints"}, "after saying \"assertion failed: prior\""),
      bad<SharesItsState>("SharesItsState", {"beside"}, "when it worked alone", {"threads"}),
      bad<SharesABuffer>("SharesABuffer", {"threads"}, "when it worked alone"),
      bad<DiffersFromRunToRun>("DiffersFromRunToRun", {"repeats"}, "with the same seed once \"frame 1: "),
      bad<FollowsOutOfThePicture>("FollowsOutOfThePicture", {"leaves"},
                                  "outside of the picture of 160 x 120 px"),
      bad<EatsMemory>("EatsMemory", {"refuses"},
                      "of infinite width (x 30, y 40, inf x 28 px): ran out of memory"),
      bad<RefusesSmallBoxes>("RefusesSmallBoxes", {"starts"}, "the smallest box"),
      bad<ThrowsNoErrors>("ThrowsNoErrors", {"refuses"}, "threw \"twice\", which is no Error"),
      bad<RefusesAnotherFormat>("RefusesAnotherFormat", {"grey"}, "threw the Error \"another format\""),
      bad<StaysAtTheStart>("StaysAtTheStart", {"follows"}, "overlaps the target by 0.00")};
}

Conformance checked(const TrackerEntry& entry) {
  Methods methods;
  methods.trackers.add(entry);
  return check_method(methods, {entry.name, {}}, quick());
}

TrackerEntry entry_of(const Case& one) {
  return {.name = "mine", .sentence = "one of the test's", .make = [&one](const Options&, std::uint64_t) {
            return one.make();
          }};
}

class BadTracker : public testing::TestWithParam<Case> {};

TEST_P(BadTracker, IsCaughtByTheCheckThatAsksForItsPromise) {
  const Conformance found = checked(entry_of(GetParam()));
  std::set<std::string> caught_by = failures(found);
  for (const std::string& check : GetParam().sometimes) caught_by.erase(check);
  EXPECT_EQ(caught_by, GetParam().caught_by);
  const std::string why = reason(found, *GetParam().caught_by.begin());
  EXPECT_NE(why.find(GetParam().reason), std::string::npos) << why;
}

INSTANTIATE_TEST_SUITE_P(Conformance, BadTracker, testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

TEST(Conformance, FindsNothingInATrackerThatKeepsItsPromises) {
  const Case good{"Good", [] { return std::make_unique<Good>(); }, {}, {}};
  const Conformance found = checked(entry_of(good));
  EXPECT_EQ(failures(found), std::set<std::string>{});
  EXPECT_EQ(found.count(CheckResult::Kind::not_asked), 0u);
}

TEST(Conformance, DoesNotAskForRepeatedAnswersWhereTheEntrySaysThatTheyDiffer) {
  const Case one = bad<DiffersFromRunToRun>("DiffersFromRunToRun", {}, {});
  TrackerEntry entry = entry_of(one);
  entry.deterministic = false;
  const Conformance found = checked(entry);
  EXPECT_EQ(failures(found), std::set<std::string>{});
  EXPECT_EQ(reason(found, "repeats"), "its entry says that its answers differ from run to run");
}

TEST(Conformance, WantsASentenceAndAUnitForEveryOption) {
  const Case good{"Good", [] { return std::make_unique<Good>(); }, {}, {}};
  for (const OptionInfo& option :
       {OptionInfo{"reach_px", "3", "px", ""}, OptionInfo{"reach_px", "3", "", "how far"}}) {
    TrackerEntry entry = entry_of(good);
    entry.options = {option};
    EXPECT_EQ(failures(checked(entry)), std::set<std::string>{"options"});
  }
}

TEST(Conformance, IsNotBegunWithAnOptionOutOfRange) {
  Methods methods = builtin_methods();
  const MethodSpec spec{"linear", {{"frames", "-3"}}};
  EXPECT_THROW(check_method(methods, spec, quick()), Error);
  EXPECT_THROW(check_method(methods, {"oracle", {}}, quick()), Error);
}

/// Sees a target where the hint is, or in the middle.
class CountingDetector final : public Detector {
 public:
  explicit CountingDetector(double step) : step_(step) {}
  Sightings detect(const Image& image, const std::optional<Box>&) override {
    if (image.empty()) return {};
    Sighting one = sighting_of(picture_box(image.size()));
    one.confidence = std::max(0.0, 1 - step_ * count_++);
    return {one};
  }

 private:
  double step_;
  int count_ = 0;
};

TEST(Conformance, FindsADetectorThatRemembersPictures) {
  for (const double step : {0.0, 1e-5}) {
    Methods methods;
    methods.detectors.add(
        {.name = "mine", .sentence = "counts", .make = [step](const Options&, std::uint64_t) {
           return std::make_unique<CountingDetector>(step);
         }});
    const Conformance found = check_method(methods, {"mine", {}}, quick());
    EXPECT_EQ(failures(found), step == 0 ? std::set<std::string>{} : std::set<std::string>{"forgets"});
    EXPECT_EQ(reason(found, "finds"), "it reads no code whose print relock can draw");
  }
}

}  // namespace
}  // namespace relock
