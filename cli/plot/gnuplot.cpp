#include "cli/plot/gnuplot.h"

#include <fmt/format.h>

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace relock::figure {
namespace {

/// A file that is nowhere but in memory: unlike a pipe it never makes anybody wait.
class MemoryFile {
 public:
  MemoryFile() : file_(memfd_create("relock-plot", MFD_CLOEXEC)) {
    if (file_ < 0) throw no_memory();
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return file_; }

  void fill(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = write(file_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) throw no_memory();
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    lseek(file_, 0, SEEK_SET);
  }

  std::string content() const {
    std::string text;
    std::array<char, 1 << 16> buffer;
    while (true) {
      const ssize_t count = pread(file_, buffer.data(), buffer.size(), static_cast<off_t>(text.size()));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return text;
      text.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  static Error no_memory() {
    return Error(fmt::format("the system gives no memory to draw a plot ({})", std::strerror(errno)));
  }

  int file_;
};

/// Ours, without what changes a drawing: numbers of another language, gnuplot's own settings, and the time.
std::vector<std::string> environment() {
  std::vector<std::string> variables{"LC_ALL=C", "SOURCE_DATE_EPOCH=0"};
  for (char** variable = environ; *variable; ++variable) {
    const std::string_view text(*variable);
    if (!text.starts_with("LC_ALL=") && !text.starts_with("SOURCE_DATE_EPOCH=") && !text.starts_with("GNU"))
      variables.emplace_back(text);
  }
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

struct Outcome {
  int status = 0;  ///< as waitpid has it
  std::string written, complaints;
};

/// Throws Error when there is no gnuplot.
Outcome run_gnuplot(std::vector<std::string> arguments, const std::string& input) {
  const MemoryFile in, out, complaints;
  in.fill(input);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, complaints.descriptor(), STDERR_FILENO);
  arguments.insert(arguments.begin(), "gnuplot");
  std::vector<std::string> variables = environment();
  pid_t child = -1;
  const int fault = posix_spawnp(&child, "gnuplot", &files, nullptr, pointers(arguments).data(),
                                 pointers(variables).data());
  posix_spawn_file_actions_destroy(&files);
  if (fault == ENOENT || fault == EACCES)
    throw Error("gnuplot is not installed, and plots are drawn by it; install the package gnuplot-nox");
  if (fault != 0) throw Error(fmt::format("gnuplot cannot be started ({})", std::strerror(fault)));
  Outcome outcome;
  while (waitpid(child, &outcome.status, 0) < 0 && errno == EINTR) {
  }
  outcome.written = out.content();
  outcome.complaints = complaints.content();
  return outcome;
}

/// The last line that is not empty: what gnuplot says before it gives up.
std::string last_line(std::string_view text) {
  const auto end = text.find_last_not_of(" \t\r\n");
  if (end == std::string_view::npos) return "it does not say why";
  text = text.substr(0, end + 1);
  text = text.substr(text.rfind('\n') + 1);
  return std::string(text.substr(text.find_first_not_of(" \t")));
}

}  // namespace

bool gnuplot_is_there() {
  try {
    return run_gnuplot({"--version"}, {}).status == 0;
  } catch (const Error&) {
    return false;
  }
}

std::string gnuplot(const std::string& script) {
  Outcome outcome = run_gnuplot({"--default-settings", "-"}, script);
  if (outcome.status != 0 || outcome.written.empty())
    throw Error(fmt::format("gnuplot draws no plot: {}", last_line(outcome.complaints)));
  return std::move(outcome.written);
}

}  // namespace relock::figure
