#include "cli/conformance/guarded_picture.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

#include "core/error.h"

namespace relock {
namespace {

/// What a signal handler may read: plain arrays.
enum class Fault : std::uint8_t { none, writes, outside, gone };
constexpr std::array<const char*, 4> kWords{"", "[wrong touch: writes]", "[wrong touch: outside]",
                                            "[wrong touch: gone]"};
constexpr std::array<const char*, 4> kClauses{
    "", "writes into the picture it is given", "reads outside of the picture's rows",
    "reads the pixels of an earlier frame, which live only until the next one is asked for"};

struct Region {
  std::atomic<std::uintptr_t> begin{0}, end{0};
  std::atomic<std::uintptr_t> pixels{0}, pixels_end{0};
  std::atomic<Fault> in_pixels{Fault::none};
};
std::array<Region, 128> regions;  // NOLINT: signal handlers see globals only

std::size_t free_slot() {
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[i].end == 0) return i;
  throw Error("there are too many guarded pictures at once");
}

void on_wrong_touch(int signal, siginfo_t* info, void*) {
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  for (const Region& region : regions)
    if (address >= region.begin && address < region.end) {
      const bool in_pixels = address >= region.pixels && address < region.pixels_end;
      const Fault fault = in_pixels ? region.in_pixels.load() : Fault::outside;
      const char* word = kWords[static_cast<std::size_t>(fault)];
      // If even this fails, the signal itself is told.
      if (write(STDERR_FILENO, word, std::strlen(word)) < 0) break;
      break;
    }
  std::signal(signal, SIG_DFL);  // the touch is tried again, and ends the process
}

std::size_t whole_pages(std::size_t bytes) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return (bytes + page - 1) / page * page;
}

}  // namespace

GuardedPicture::GuardedPicture(const Picture& picture, Guard guard, std::uint8_t between) {
  constexpr std::size_t kBetweenRows = 13;  // odd, so that rows begin anywhere
  const std::size_t page = whole_pages(1), row = picture.row_bytes(), stride = row + kBetweenRows;
  const auto rows = static_cast<std::size_t>(picture.size.height);
  const std::size_t pixels = stride * (rows - 1) + row;
  const bool has_room = guard == Guard::writing || guard == Guard::later;
  const std::size_t room = whole_pages(pixels) + (has_room ? 2 * page : 0);
  bytes_ = room + 2 * page;
  slot_ = free_slot();
  void* memory = mmap(nullptr, bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw Error("there is not enough memory for a guarded picture");
  memory_ = static_cast<std::uint8_t*>(memory);
  std::uint8_t* open = memory_ + page;
  mprotect(open, room, PROT_READ | PROT_WRITE);
  std::memset(open, between, room);
  std::uint8_t* first = has_room ? open + page : guard == Guard::before ? open : open + room - pixels;
  for (std::size_t y = 0; y < rows; ++y) std::memcpy(first + y * stride, picture.bytes.data() + y * row, row);
  if (guard == Guard::writing) mprotect(open, room, PROT_READ);
  image_ = Image(first, picture.size, picture.format, stride);

  Region& region = regions[slot_];
  region.begin = reinterpret_cast<std::uintptr_t>(memory_);
  region.pixels = reinterpret_cast<std::uintptr_t>(open);
  region.pixels_end = region.pixels + room;
  region.in_pixels = Fault::writes;
  region.end = region.begin + bytes_;
}

GuardedPicture::~GuardedPicture() {
  regions[slot_].end = 0;
  munmap(memory_, bytes_);
}

void GuardedPicture::take_away() {
  regions[slot_].in_pixels = Fault::gone;
  mprotect(memory_, bytes_, PROT_NONE);
}

void tell_wrong_touches() {
  struct sigaction action {};
  action.sa_sigaction = on_wrong_touch;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSEGV, &action, nullptr);
  sigaction(SIGBUS, &action, nullptr);
}

std::string wrong_touch(std::string_view said) {
  for (std::size_t i = 1; i < kWords.size(); ++i)
    if (said.find(kWords[i]) != std::string_view::npos) return kClauses[i];
  return {};
}

}  // namespace relock
