// What a still takes, by size of picture, blur and diameter, on one thread.
#include <fmt/format.h>

#include <ctime>
#include <opencv2/core/utility.hpp>

#include "cli/print/targets.h"
#include "sequences/simulator/stills.h"

namespace relock::simulator {
namespace {

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void print_cost(Size picture, double blur_px, const std::vector<PrintedTarget>& targets) {
  StillPlan plan;
  plan.picture = picture;
  plan.blurs_px = {blur_px};
  const std::size_t count = picture.width > 1000 ? 12 : 60;
  const double begun = processor_ms();
  for (std::size_t rank = 0; rank < count; ++rank) still(plan, targets, rank, 1);
  fmt::print("  {:>4}x{:<4}  blur {:>3} px  {:6.1f} ms\n", picture.width, picture.height, blur_px,
             (processor_ms() - begun) / static_cast<double>(count));
}

}  // namespace
}  // namespace relock::simulator

int main() {
  using namespace relock;
  cv::setNumThreads(1);
  const std::vector targets{print_target("ring:01", 0.15), print_target("aruco6x6_250:23", 0.15)};
  fmt::print("stills in clutter, 60 to 150 px large, tilted by up to 45 degrees: processor time of each\n");
  for (const Size picture : {Size{640, 480}, Size{1920, 1080}})
    for (const double blur_px : {0, 30, 65, 100}) simulator::print_cost(picture, blur_px, targets);
}
