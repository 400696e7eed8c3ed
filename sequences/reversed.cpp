#include "sequences/reversed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"

namespace relock {
namespace {

/// A decoded picture, or why there is none.
struct Kept {
  std::vector<std::uint8_t> pixels;
  Size size;
  PixelFormat format = PixelFormat::gray8;
  std::string fault = "this picture was not reached";

  void keep(const Image& image) {
    size = image.size();
    format = image.format();
    const std::size_t row = stride();
    pixels.resize(row * static_cast<std::size_t>(size.height));
    for (int y = 0; y < size.height; ++y)
      std::memcpy(pixels.data() + static_cast<std::size_t>(y) * row, image.row(y), row);
    fault.clear();
  }
  std::size_t stride() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels(format));
  }
};

class Reversed final : public FrameSource {
 public:
  Reversed(std::function<std::unique_ptr<FrameSource>()> open, const ReversedOptions& options)
      : open_(std::move(open)) {
    const auto source = open_();
    captured_ = reflected(source->captured());
    size_ = source->picture_size();
    const std::size_t bytes =
        static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height) * 3;
    stretch_ = std::max<std::size_t>(1, options.budget_bytes / std::max<std::size_t>(1, bytes));
  }

  std::span<const Time> captured() const override { return captured_; }
  Size picture_size() const override { return size_; }

  std::optional<FrameStamp> next() override {
    if (next_ >= captured_.size()) return {};
    const std::size_t index = next_++;
    return FrameStamp{static_cast<FrameIndex>(index), captured_[index]};
  }

  Image image() override {
    const std::size_t recorded = captured_.size() - next_;
    if (recorded < first_ || recorded >= first_ + kept_.size()) read_stretch_up_to(recorded);
    const Kept& kept = kept_[recorded - first_];
    if (!kept.fault.empty()) throw Error(kept.fault);
    return Image(kept.pixels.data(), kept.size, kept.format, kept.stride());
  }

 private:
  /// Stretches begin at multiples of their length. What lies behind `recorded` in its stretch has been played.
  void read_stretch_up_to(std::size_t recorded) {
    first_ = recorded / stretch_ * stretch_;
    kept_.clear();  // before the new ones are there: the budget is for one stretch
    kept_.resize(recorded + 1 - first_);
    const auto source = open_();
    try {
      while (const auto stamp = source->next()) {
        const auto frame = static_cast<std::size_t>(stamp->index);
        if (frame > recorded) break;
        if (frame >= first_) keep(*source, kept_[frame - first_]);
      }
    } catch (const Error& of_reading_on) {
      for (Kept& kept : kept_)
        if (kept.pixels.empty()) kept.fault = of_reading_on.what();
    }
  }

  static void keep(FrameSource& source, Kept& kept) {
    try {
      kept.keep(source.image());
    } catch (const Error& of_this_picture) {
      kept.fault = of_this_picture.what();
    }
  }

  std::function<std::unique_ptr<FrameSource>()> open_;
  std::vector<Time> captured_;
  Size size_;
  std::size_t stretch_ = 1;  // frames
  std::size_t next_ = 0;     // as played
  std::size_t first_ = 0;    // recorded frame of …
  std::vector<Kept> kept_;   // … these
};

}  // namespace

std::unique_ptr<FrameSource> reversed(std::function<std::unique_ptr<FrameSource>()> open,
                                      const ReversedOptions& options) {
  return std::make_unique<Reversed>(std::move(open), options);
}

}  // namespace relock
