#include "tests/sequences/scratch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

namespace relock {

Scratch::Scratch() {
  static int count = 0;
  path_ = std::filesystem::temp_directory_path() / fmt::format("relock-test-{}-{}", getpid(), count++);
  std::filesystem::create_directories(path_);
}

void Scratch::write(const std::string& name, const std::string& content) const {
  std::filesystem::create_directories((path_ / name).parent_path());
  std::ofstream(path_ / name, std::ios::binary) << content;
}

void Scratch::write_pictures(int count, int width, int height) const {
  std::filesystem::create_directories(path_ / "images");
  for (int i = 0; i < count; ++i)
    cv::imwrite((path_ / "images" / fmt::format("{}.png", i)).string(),
                cv::Mat1b(height, width, static_cast<std::uint8_t>(10 + i)));
}

}  // namespace relock
