// What replay costs beside decoding, with a method that does nothing: CPU time a frame and anonymous memory.
// Usage: replay_cost [RECORDING [PASSES]]      recordings/klahaag and 20 if not given

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/error.h"
#include "eval/replay/replay.h"
#include "eval/replay/yardsticks.h"
#include "sequences/open.h"

namespace {

double cpu_ms() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return ms(used.ru_utime) + ms(used.ru_stime);
}

/// Anonymous memory of this process, MB.
double anonymous_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("RssAnon:")) return std::stod(line.substr(8)) / 1024;
  return 0;
}

void decode_only(const relock::Sequence& sequence) {
  const auto source = sequence.frames();
  while (source->next()) source->image();
}

void replay_mute(const relock::Sequence& sequence) {
  const auto source = sequence.frames();
  const auto method = relock::mute();
  relock::replay(*method, *source, sequence.recording, relock::Schedule(sequence.recording.frames()), {});
}

/// CPU milliseconds a frame: the least of several rounds, as other work on the machine only adds.
template <class Work>
double ms_per_frame(const relock::Sequence& sequence, int passes, Work work) {
  double least = 1e9;
  for (int round = 0; round < 5; ++round) {
    const double begun = cpu_ms();
    for (int pass = 0; pass < passes; ++pass) work(sequence);
    least = std::min(least, (cpu_ms() - begun) / passes / static_cast<double>(sequence.recording.frames()));
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) try {
  const cv::Mat bare(360, 640, CV_8UC3, cv::Scalar(0));  // OpenCV is loaded and holds one picture
  const double bare_mb = anonymous_mb();
  const auto sequence = relock::open_sequence(argc > 1 ? argv[1] : "recordings/klahaag");
  const int passes = argc > 2 ? std::stoi(argv[2]) : 20;
  const double decode = ms_per_frame(sequence, passes, decode_only);
  const double replay = ms_per_frame(sequence, passes, replay_mute);
  const auto size = sequence.recording.picture;
  fmt::print("decoding alone     {:.3f} ms CPU a frame of {}x{}\n", decode, size.width, size.height);
  fmt::print("replay with mute   {:.3f} ms CPU a frame: {:+.3f} ms\n", replay, replay - decode);
  fmt::print("anonymous memory   {:.1f} MB, {:.1f} MB beyond a process with OpenCV and one picture\n",
             anonymous_mb(), anonymous_mb() - bare_mb);
} catch (const relock::Error& fault) {
  fmt::print(stderr, "replay_cost: {}\n", fault.what());
  return 2;
}
