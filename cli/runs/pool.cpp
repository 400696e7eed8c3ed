#include "cli/runs/pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "core/error.h"

namespace relock {
namespace {

using Clock = std::chrono::steady_clock;

/// How long the rest will take, from how long each method has taken for a frame so far.
class Pace {
 public:
  void made(const std::string& method, std::size_t frames, double seconds) {
    for (Sum* sum : {&of_[method], &all_})
      sum->frames += static_cast<double>(frames), sum->seconds += seconds;
  }
  double seconds_for(const std::string& method, std::size_t frames) const {
    const auto at = of_.find(method);
    const Sum& sum = at == of_.end() ? all_ : at->second;
    return sum.frames > 0 ? sum.seconds / sum.frames * static_cast<double>(frames) : 0;
  }
  bool knows_anything() const { return all_.frames > 0; }

 private:
  struct Sum {
    double frames = 0, seconds = 0;
  };
  std::map<std::string, Sum> of_;
  Sum all_;
};

class Pool {
 public:
  Pool(const Matrix& matrix, const std::vector<std::size_t>& todo, const RunLimits& limits, int jobs,
       const PoolReport& report)
      : matrix_(matrix), todo_(todo), limits_(limits), jobs_(jobs), report_(report) {}

  bool make_all() {
    const InterruptNote note;
    while (!note.asked() && (next_ < todo_.size() || !busy_.empty())) {
      while (next_ < todo_.size() && busy_.size() < static_cast<std::size_t>(jobs_)) begin(todo_[next_++]);
      wait();
      look_at_all();
      show_progress();
    }
    const bool all = next_ == todo_.size() && busy_.empty();
    busy_.clear();
    return all;
  }

 private:
  struct Busy {
    std::size_t run;
    Clock::time_point begun;
    std::unique_ptr<Worker> worker;
  };

  void begin(std::size_t run) {
    busy_.push_back({run, Clock::now(), std::make_unique<Worker>(matrix_, matrix_.runs[run], limits_)});
  }

  void wait() const {
    std::vector<const Child*> children;
    for (const Busy& busy : busy_) children.push_back(&busy.worker->child());
    Child::wait_for_any(children, std::chrono::seconds(1));
  }

  void look_at_all() {
    for (std::size_t i = 0; i < busy_.size();) {
      if (look_at(busy_[i])) {
        busy_.erase(busy_.begin() + static_cast<std::ptrdiff_t>(i));
        ++made_;
      } else {
        ++i;
      }
    }
  }

  /// Whether it has ended.
  bool look_at(Busy& busy) {
    std::optional<FinishedRun> done;
    try {
      done = busy.worker->look();
    } catch (const Error& fault) {
      report_.not_made(busy.run, fault.what());
      return true;
    }
    if (!done) return false;
    pace_.made(matrix_.runs[busy.run].method.text, frames(busy.run), elapsed(busy));
    store_run(matrix_.runs[busy.run].folder, *done);
    report_.finished(busy.run, *done);
    return true;
  }

  std::size_t frames(std::size_t run) const {
    return matrix_.sequence_of(matrix_.runs[run]).recording.frames();
  }
  static double elapsed(const Busy& busy) {
    return std::chrono::duration<double>(Clock::now() - busy.begun).count();
  }

  void show_progress() {
    double left = 0;
    for (std::size_t i = next_; i < todo_.size(); ++i)
      left += pace_.seconds_for(matrix_.runs[todo_[i]].method.text, frames(todo_[i]));
    for (const Busy& busy : busy_) {
      const double done = static_cast<double>(busy.worker->frames_done());
      const double rest = static_cast<double>(frames(busy.run)) - done;
      left += done > 0 ? elapsed(busy) / done * rest : 0;
    }
    std::string text = fmt::format("{} of {} runs", made_, todo_.size());
    for (const Busy& busy : busy_)
      text += fmt::format(
          "  {} {:.0f} %", busy.worker->run().method.text,
          100.0 * static_cast<double>(busy.worker->frames_done()) / static_cast<double>(frames(busy.run)));
    if (pace_.knows_anything() || todo_.size() == busy_.size())
      text += fmt::format("  {} left", spoken_time(left / jobs_));
    progress_.show(text);
  }

  const Matrix& matrix_;
  const std::vector<std::size_t>& todo_;
  const RunLimits& limits_;
  const int jobs_;
  const PoolReport& report_;
  std::vector<Busy> busy_;
  std::size_t next_ = 0, made_ = 0;
  Pace pace_;
  ProgressLine progress_;
};

}  // namespace

bool make_runs(const Matrix& matrix, const std::vector<std::size_t>& todo, const RunLimits& limits, int jobs,
               const PoolReport& report) {
  return Pool(matrix, todo, limits, jobs, report).make_all();
}

std::string spoken_time(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  const auto whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace relock
