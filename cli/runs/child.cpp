#include "cli/runs/child.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <utility>

#include "core/error.h"

namespace relock {
namespace {

constexpr std::size_t kTail = 600;  // bytes of its output that are kept
enum class Word : char { message = 'm', threw = 't', finished = 'f' };

// On the pipe: the word, the length as eight bytes, the text.
constexpr std::size_t kHead = 1 + sizeof(std::uint64_t);

void write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);  // nobody listens any more
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

void say(int file, Word word, std::string_view text) {
  std::string framed(kHead, static_cast<char>(word));
  const std::uint64_t size = text.size();
  std::memcpy(framed.data() + 1, &size, sizeof size);
  framed += text;
  write_all(file, framed.data(), framed.size());
}

/// Private, writable memory that this process has now.
std::uint64_t data_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmData:")) return std::strtoull(line.c_str() + 7, nullptr, 10) * 1024;
  return 0;
}

void limit_memory(std::uint64_t bytes) {
  const rlim_t most = data_bytes() + bytes;
  const rlimit limit{most, most};
  setrlimit(RLIMIT_DATA, &limit);
}

struct Pipe {
  int read = -1, write = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(fmt::format("the system gives no pipe to a child process ({})", std::strerror(errno)));
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return {ends[0], ends[1]};
}

/// Everything that can be read without waiting.
void read_into(int file, std::string& bytes) {
  std::array<char, 1 << 16> buffer;
  while (true) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::string signal_name(int signal) {
  const char* name = sigabbrev_np(signal);
  return name ? fmt::format("signal {} (SIG{})", signal, name) : fmt::format("signal {}", signal);
}

}  // namespace

Child::Child(const std::function<void(const Tell&)>& work, const ChildLimits& limits) : limits_(limits) {
  const Pipe messages = make_pipe(), output = make_pipe();
  std::fflush(nullptr);  // what is buffered is the parent's to write
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) {
    for (const int file : {messages.read, messages.write, output.read, output.write}) close(file);
    throw Error(fmt::format("the system gives no child process ({})", std::strerror(errno)));
  }
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    close(messages.read);
    close(output.read);
    be_the_child(work, messages.write, output.write);
  }
  setpgid(pid_, pid_);  // here too: it may be killed before it got to its own call
  close(messages.write);
  close(output.write);
  messages_ = messages.read;
  output_ = output.read;
}

Child::~Child() {
  kill();
  close(messages_);
  close(output_);
}

void Child::be_the_child(const std::function<void(const Tell&)>& work, int messages, int output) {
  setpgid(0, 0);  // what it starts itself dies with it
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  std::signal(SIGPIPE, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (limits_.memory_bytes) limit_memory(*limits_.memory_bytes);
  Word word = Word::finished;
  std::string why;
  try {
    work([messages](std::string_view text) { say(messages, Word::message, text); });
  } catch (const std::bad_alloc&) {
    word = Word::threw;
    why = kRanOutOfMemory;
  } catch (const std::exception& fault) {
    word = Word::threw;
    why = fault.what();
  } catch (...) {
    word = Word::threw;
    why = "threw something that is no exception";
  }
  std::fflush(nullptr);
  say(messages, word, why);
  _exit(0);  // without taking anything apart: libraries crash there, and memory is given back anyway
}

void Child::read_all() {
  const std::size_t before = bytes_.size();
  read_into(messages_, bytes_);
  if (bytes_.size() > before) heard_ = std::chrono::steady_clock::now();
  read_into(output_, tail_);
  if (tail_.size() > kTail) tail_.erase(0, tail_.size() - kTail);
  parse();
}

void Child::parse() {
  std::size_t at = 0;
  while (bytes_.size() - at >= kHead) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes_.data() + at + 1, sizeof size);
    if (bytes_.size() - at - kHead < size) break;
    std::string text = bytes_.substr(at + kHead, size);
    switch (static_cast<Word>(bytes_[at])) {
      case Word::message:
        told_.push_back(std::move(text));
        break;
      case Word::threw:
        last_word_ = ChildEnd{ChildEnd::Kind::threw, std::move(text)};
        break;
      case Word::finished:
        last_word_ = ChildEnd{};
        break;
    }
    at += kHead + size;
  }
  bytes_.erase(0, at);
}

std::vector<std::string> Child::take() {
  read_all();
  return std::exchange(told_, {});
}

ChildEnd Child::end_of(int status) const {
  ChildEnd end{ChildEnd::Kind::crashed};
  if (last_word_) {
    end = *last_word_;
  } else if (WIFSIGNALED(status)) {
    end.what = "was killed by " + signal_name(WTERMSIG(status));
  } else {
    end.what = fmt::format("left the program with status {}", WEXITSTATUS(status));
  }
  end.tail = tail_;
  return end;
}

std::optional<ChildEnd> Child::end() {
  if (!end_) {
    int status = 0;
    // First whether it has ended, then what is left to read: nothing can come in between.
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      read_all();
      ::kill(-pid_, SIGKILL);
      pid_ = -1;
      end_ = end_of(status);
    } else if (limits_.silence && std::chrono::steady_clock::now() - heard_ > *limits_.silence) {
      read_all();
      kill();
      end_ = ChildEnd{
          ChildEnd::Kind::hung,
          fmt::format("gave no answer for {:.3g} s", std::chrono::duration<double>(*limits_.silence).count()),
          tail_};
    }
  }
  if (!told_.empty()) return {};
  return end_;
}

void Child::kill() {
  if (pid_ < 0) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
}

void Child::wait_for_any(std::span<const Child* const> children, std::chrono::milliseconds at_most) {
  // A child's own children may hold its pipes open after its end: it is looked after again before long.
  constexpr std::chrono::milliseconds kLook{50};
  std::vector<pollfd> files;
  for (const Child* child : children)
    for (const int file : {child->messages_, child->output_}) files.push_back({file, POLLIN, 0});
  poll(files.data(), files.size(), static_cast<int>(std::min(at_most, kLook).count()));
}

ChildResult run_in_child(const std::function<void(const Tell&)>& work, const ChildLimits& limits) {
  Child child(work, limits);
  ChildResult result;
  const std::array<const Child*, 1> one{&child};
  while (true) {
    for (std::string& message : child.take()) result.messages.push_back(std::move(message));
    if (auto end = child.end()) {
      result.end = *std::move(end);
      return result;
    }
    Child::wait_for_any(one, std::chrono::seconds(1));
  }
}

}  // namespace relock
