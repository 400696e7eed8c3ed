// A child process may do anything: its parent hears of it and goes on.
#include "cli/runs/child.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

namespace relock {
namespace {

using namespace std::chrono_literals;
using Kind = ChildEnd::Kind;

TEST(Child, TellsItsMessagesWholeAndInOrder) {
  const auto result = run_in_child([](const Tell& tell) {
    for (int i = 0; i < 2000; ++i) tell(std::string(static_cast<std::size_t>(i), 'x'));
  });
  EXPECT_EQ(result.end.kind, Kind::finished);
  ASSERT_EQ(result.messages.size(), 2000u);
  for (std::size_t i = 0; i < 2000; ++i) EXPECT_EQ(result.messages[i].size(), i);
}

TEST(Child, LeavesItsParentsMemoryAlone) {
  int changed = 0;
  run_in_child([&](const Tell&) { changed = 1; });
  EXPECT_EQ(changed, 0);
}

TEST(Child, ThatThrowsSaysWhat) {
  const auto result = run_in_child([](const Tell& tell) {
    tell("one");
    throw std::runtime_error("no more");
  });
  EXPECT_EQ(result.end.kind, Kind::threw);
  EXPECT_EQ(result.end.what, "no more");
  EXPECT_EQ(result.messages, std::vector<std::string>{"one"});
}

TEST(Child, ThatIsKilledNamesTheSignalAndKeepsWhatItSaidBefore) {
  const auto result = run_in_child([](const Tell& tell) {
    tell("one");
    std::fputs("so long\n", stderr);
    std::raise(SIGKILL);
  });
  EXPECT_EQ(result.end.kind, Kind::crashed);
  EXPECT_EQ(result.end.what, "was killed by signal 9 (SIGKILL)");
  EXPECT_EQ(result.end.tail, "so long\n");
  EXPECT_EQ(result.messages, std::vector<std::string>{"one"});
}

TEST(Child, ThatLeavesTheProgramByItselfIsACrash) {
  const auto result = run_in_child([](const Tell&) { _exit(0); });
  EXPECT_EQ(result.end.kind, Kind::crashed);
  EXPECT_EQ(result.end.what, "left the program with status 0");
}

TEST(Child, ThatIsSilentForTooLongIsKilled) {
  const auto result = run_in_child(
      [](const Tell& tell) {
        tell("one");
        while (true) std::this_thread::sleep_for(1s);
      },
      {.silence = 200ms});
  EXPECT_EQ(result.end.kind, Kind::hung);
  EXPECT_EQ(result.end.what, "gave no answer for 0.2 s");
  EXPECT_EQ(result.messages, std::vector<std::string>{"one"});
}

TEST(Child, ThatKeepsTellingIsNotKilled) {
  const auto result = run_in_child(
      [](const Tell& tell) {
        for (int i = 0; i < 10; ++i) {
          std::this_thread::sleep_for(100ms);
          tell("still here");
        }
      },
      {.silence = 900ms});
  EXPECT_EQ(result.end.kind, Kind::finished);
}

TEST(Child, ThatAllocatesBeyondItsLimitSaysSo) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer takes the memory itself";
#endif
  const auto result = run_in_child(
      [](const Tell& tell) {
        std::vector<char> large(500'000'000, 1);
        tell(std::to_string(large[1000]));
      },
      {.memory_bytes = 100'000'000});
  EXPECT_EQ(result.end.kind, Kind::threw);
  EXPECT_EQ(result.end.what, "ran out of memory");
}

TEST(Child, KeepsTheTailOfALongOutput) {
  const auto result = run_in_child([](const Tell&) {
    for (int i = 0; i < 100'000; ++i) std::printf("line %d\n", i);
  });
  EXPECT_EQ(result.end.kind, Kind::finished);
  EXPECT_LT(result.end.tail.size(), 1000u);
  EXPECT_TRUE(result.end.tail.ends_with("line 99999\n"));
}

TEST(Child, DiesWithItsObjectAndTakesItsOwnChildrenAlong) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  {
    Child child([&](const Tell& tell) {
      if (fork() == 0) pause();  // a grandchild, which holds the pipe open
      tell("ready");
      pause();
    });
    const std::array<const Child*, 1> one{&child};
    while (child.take().empty()) Child::wait_for_any(one, 100ms);
  }
  close(pipe_ends[1]);
  char byte = 0;
  EXPECT_EQ(read(pipe_ends[0], &byte, 1), 0);  // the end of the file comes when the last holder is gone
  close(pipe_ends[0]);
}

}  // namespace
}  // namespace relock
