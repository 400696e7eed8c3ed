#include "cli/in_parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace relock {

void in_parallel(std::size_t count, int jobs, const std::function<Work()>& make_worker) {
  std::atomic<std::size_t> next{0};
  std::mutex faulting;
  std::exception_ptr fault;
  const auto work = [&] {
    try {
      const Work worker = make_worker();
      for (std::size_t index = next++; index < count; index = next++) worker(index);
    } catch (...) {
      const std::lock_guard lock(faulting);
      if (!fault) fault = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace relock
