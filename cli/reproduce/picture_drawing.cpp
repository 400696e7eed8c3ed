// How the pictures of `relock reproduce` are put together.

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "cli/drawing.h"
#include "cli/reproduce/folder.h"
#include "cli/reproduce/pictures.h"

namespace relock::reproduction {
namespace {

constexpr int kCaption_px = 22, kGap_px = 4;
constexpr double kLetters = 0.45;
const cv::Scalar kPaper(255, 255, 255), kInk(0, 0, 0), kLabel(0, 94, 213);

/// "2" of the code 10; other codes as they are.
std::string decimal(const Code& code) {
  if (code.value.empty() || code.value.find_first_not_of("01") != std::string::npos) return to_string(code);
  return fmt::format("{}", std::stoul(code.value, nullptr, 2));
}

void write(cv::Mat& picture, const std::string& text, cv::Point at, double size, const cv::Scalar& colour) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat with_answers(const cv::Mat& picture, const Sightings& sightings) {
  cv::Mat answered = drawn(picture, sightings);
  for (const Sighting& sighting : sightings) {
    if (!sighting.code) continue;
    const cv::Point at(static_cast<int>(sighting.centre.x) + 8, static_cast<int>(sighting.centre.y) - 8);
    write(answered, decimal(*sighting.code), at, 1.0, kLabel);
  }
  return answered;
}

cv::Mat captioned(const cv::Mat& picture, const std::string& caption) {
  cv::Mat with;
  cv::copyMakeBorder(picture, with, 0, kCaption_px, 0, 0, cv::BORDER_CONSTANT, kPaper);
  write(with, caption, {2, picture.rows + kCaption_px - 7}, kLetters, kInk);
  return with;
}

cv::Mat in_rows(const std::vector<cv::Mat>& pictures, int columns) {
  const cv::Size size = pictures.front().size() + cv::Size(kGap_px, kGap_px);
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  cv::Mat all(rows * size.height, columns * size.width, CV_8UC3, kPaper);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    pictures[i].copyTo(all({cv::Point(column * size.width, row * size.height), pictures[i].size()}));
  }
  return all;
}

std::filesystem::path write_figure(const Settings& settings, const std::string& id, const cv::Mat& picture) {
  cv::Mat marked = picture;
  if (settings.quick) {
    cv::copyMakeBorder(picture, marked, kCaption_px, 0, 0, 0, cv::BORDER_CONSTANT, kPaper);
    write(marked, "QUICK", {2, kCaption_px - 7}, kLetters, kInk);
  }
  const auto file = file_of(settings, id, 0, ".png");
  write_picture(file, marked);
  return file;
}

}  // namespace relock::reproduction
