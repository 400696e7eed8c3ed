// What a worker process costs to start, as `relock run` starts one for every run.
// Usage: worker_cost [RUNS]      200 if not given

#include <fmt/format.h>

#include <chrono>
#include <string>

#include "cli/runs/child.h"
#include "sequences/open.h"

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::stoi(argv[1]) : 200;
  const auto sequence = relock::open_sequence("recordings/klahaag");  // the libraries are loaded and warm
  const auto begun = std::chrono::steady_clock::now();
  for (int run = 0; run < runs; ++run) relock::run_in_child([](const relock::Tell& tell) { tell("done"); });
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begun;
  fmt::print("a worker process   {:.2f} ms from its start to its end, of {} in a row\n", spent.count() / runs,
             runs);
}
