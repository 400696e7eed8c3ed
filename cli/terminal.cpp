#include "cli/terminal.h"

#include <fmt/format.h>

#include <langinfo.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <cstring>

namespace relock {
namespace {

constexpr auto kRedraw = std::chrono::milliseconds(200);

int width_of(std::FILE* stream) {
  if (const char* columns = std::getenv("COLUMNS")) {
    const int asked = std::atoi(columns);
    if (asked > 0) return asked;
  }
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 120;
}

bool set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

}  // namespace

Terminal terminal(std::FILE* stream) {
  Terminal found;
  found.is_terminal = isatty(fileno(stream)) == 1;
  std::setlocale(LC_CTYPE, "");  // what letters are; numbers stay as they are
  found.unicode = found.is_terminal && std::strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
  const char* term = std::getenv("TERM");
  found.colour = found.is_terminal && !set("NO_COLOR") && term && std::strcmp(term, "dumb") != 0;
  found.width = width_of(stream);
  return found;
}

std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(std::string_view text, std::size_t columns) {
  const std::size_t used = columns_of(text);
  return std::string(text) + std::string(columns > used ? columns - used : 0, ' ');
}

std::string right_aligned(std::string_view text, std::size_t columns) {
  const std::size_t used = columns_of(text);
  return std::string(columns > used ? columns - used : 0, ' ') + std::string(text);
}

ProgressLine::~ProgressLine() {
  if (shown_ && drawn_ != Clock::time_point{}) fmt::print(stderr, "\r\x1b[K");
}

void ProgressLine::show(std::string_view text) {
  const auto now = Clock::now();
  if (!shown_ || now - drawn_ < kRedraw) return;
  drawn_ = now;
  const auto room = static_cast<std::size_t>(std::max(10, width_of(stderr) - 1));
  fmt::print(stderr, "\r\x1b[K{}", text.substr(0, room));
  std::fflush(stderr);
}

void Progress::done(std::int64_t steps) {
  if (steps <= 0) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  const double left = elapsed / static_cast<double>(steps) * static_cast<double>(total_ - steps);
  line_.show(fmt::format("{}  {} of {}  {:.0f} s left", what_, steps, total_, left));
}

}  // namespace relock
