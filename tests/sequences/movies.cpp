#include "tests/sequences/movies.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace relock {

bool has_ffmpeg() { return std::system("ffmpeg -version >/dev/null 2>&1") == 0; }

void ffmpeg(const std::string& arguments) {
  const std::string command = "ffmpeg -nostdin -v error -y " + arguments + " </dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

std::string barred(int slots, const std::string& size) {
  return fmt::format(
      "-f lavfi -i \"color=gray:size={}:rate=30:duration={},format=gray,"
      "geq=lum='255*mod(floor(N/pow(2\\,floor(X/8)))\\,2)',format=yuv420p\" ",
      size, slots / 30.0);
}

const std::string kGaps =
    " -vf \"select='not(between(n,30,74))*not(between(n,90,104))*mod(n\\,7)'\" -fps_mode passthrough ";

std::vector<int> slots_left(int slots) {
  std::vector<int> left;
  for (int n = 0; n < slots; ++n)
    if (!(n >= 30 && n <= 74) && !(n >= 90 && n <= 104) && n % 7 != 0) left.push_back(n);
  return left;
}

int slot_shown(const Image& picture) {
  const std::uint8_t* row = picture.row(picture.size().height / 2);
  int slot = 0;
  for (int bar = 0; bar < 7; ++bar)
    if (row[channels(picture.format()) * (8 * bar + 4)] > 127) slot += 1 << bar;
  return slot;
}

std::vector<int> slots_of_times(std::span<const Time> captured, int first) {
  std::vector<int> slots;
  for (const Time time : captured)
    slots.push_back(first + static_cast<int>(std::lround(30 * seconds(time - captured.front()))));
  return slots;
}

std::vector<int> slots_of_pictures(FrameSource& source) {
  std::vector<int> slots;
  while (source.next()) slots.push_back(slot_shown(source.image()));
  return slots;
}

}  // namespace relock
