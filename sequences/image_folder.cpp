#include "sequences/image_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "core/error.h"
#include "core/opencv.h"
#include "sequences/encoded_picture.h"
#include "sequences/timestamps.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

/// Natural order: frame2 before frame10.
bool before_by_name(const fs::path& a, const fs::path& b) {
  const std::string p = a.filename().string(), q = b.filename().string();
  std::size_t i = 0, j = 0;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto number_end = [&](const std::string& s, std::size_t at) {
    while (at < s.size() && digit(s[at])) ++at;
    return at;
  };
  while (i < p.size() && j < q.size()) {
    if (digit(p[i]) && digit(q[j])) {
      while (i < p.size() && p[i] == '0') ++i;
      while (j < q.size() && q[j] == '0') ++j;
      const std::size_t pe = number_end(p, i), qe = number_end(q, j);
      if (pe - i != qe - j) return pe - i < qe - j;
      if (const int order = p.compare(i, pe - i, q, j, qe - j); order != 0) return order < 0;
      i = pe, j = qe;
    } else if (p[i] != q[j]) {
      return p[i] < q[j];
    } else {
      ++i, ++j;
    }
  }
  if ((p.size() - i) != (q.size() - j)) return p.size() - i < q.size() - j;
  return p < q;
}

std::vector<fs::path> named_pictures(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> all;
  for (const std::string& name : names) all.push_back(folder / name);
  return all;
}

std::vector<Time> steady_times(std::size_t frames, Duration period) {
  std::vector<Time> times;
  for (std::size_t i = 0; i < frames; ++i) times.push_back(Time{static_cast<std::int64_t>(i) * period});
  return times;
}

class Pictures final : public FrameSource {
 public:
  Pictures(std::vector<fs::path> pictures, std::vector<Time> captured)
      : pictures_(std::move(pictures)), captured_(std::move(captured)) {
    decode(0);
    size_ = {decoded_.cols, decoded_.rows};
  }

  std::span<const Time> captured() const override { return captured_; }
  Size picture_size() const override { return size_; }

  std::optional<FrameStamp> next() override {
    if (next_ >= pictures_.size()) return {};
    const std::size_t index = next_++;
    return FrameStamp{static_cast<FrameIndex>(index), captured_[index]};
  }

  Image image() override {
    const std::size_t index = next_ - 1;
    if (decoded_index_ != index) decode(index);
    if (decoded_.cols != size_.width || decoded_.rows != size_.height)
      throw Error(fmt::format("{}: this picture is {}x{} and the first one {}x{}; all must be of one size",
                              pictures_[index].string(), decoded_.cols, decoded_.rows, size_.width,
                              size_.height));
    return view(decoded_);
  }

 private:
  /// Reads and decodes one picture.
  void decode(std::size_t index) {
    const std::string name = pictures_[index].string();
    std::ifstream in(pictures_[index], std::ios::binary | std::ios::ate);
    if (!in || !fs::is_regular_file(pictures_[index]))
      throw Error(fmt::format("{}: this picture cannot be opened", name));
    bytes_.resize(static_cast<std::size_t>(in.tellg()));
    in.seekg(0).read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    if (!in) throw Error(fmt::format("{}: this picture cannot be read to its end", name));
    decoded_index_ = static_cast<std::size_t>(-1);
    try {
      decoded_ = decode_picture(bytes_);
    } catch (const Error& fault) {
      throw Error(fmt::format("{}: {}", name, fault.what()));
    }
    decoded_index_ = index;
  }

  std::vector<fs::path> pictures_;
  std::vector<Time> captured_;
  Size size_;
  std::size_t next_ = 0;
  std::size_t decoded_index_ = static_cast<std::size_t>(-1);
  std::vector<std::uint8_t> bytes_;
  cv::Mat decoded_;
};

}  // namespace

bool is_picture(const fs::path& path) {
  static const std::vector<std::string> endings{".jpg", ".jpeg", ".png",  ".bmp", ".pgm",
                                                ".ppm", ".tif",  ".tiff", ".webp"};
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_picture(entry.path())) all.push_back(entry.path());
  std::sort(all.begin(), all.end(), before_by_name);
  return all;
}

std::vector<Time> steady_times(std::size_t frames, double rate_hz) {
  std::vector<Time> times;
  for (std::size_t i = 0; i < frames; ++i)
    times.push_back(Time{from_seconds(static_cast<double>(i) / rate_hz)});
  return times;
}

std::unique_ptr<FrameSource> open_pictures(std::vector<fs::path> pictures, std::vector<Time> captured) {
  if (pictures.empty()) throw Error("this recording has no pictures");
  if (pictures.size() != captured.size())
    throw Error(fmt::format("there are {} times for the {} pictures in {}", captured.size(), pictures.size(),
                            pictures.front().parent_path().string()));
  return std::make_unique<Pictures>(std::move(pictures), std::move(captured));
}

bool recognises_image_folder(const fs::path& path) { return fs::is_directory(path); }

TimedPictures timed_pictures(const fs::path& folder, std::vector<fs::path> pictures, const fs::path& sidecars,
                             const Description& description, const OpenOptions& options,
                             const OwnTimes& own) {
  TimedPictures timed{std::move(pictures), own.captured};
  if (const auto path = sidecars / "timestamps.csv"; fs::exists(path)) {
    auto stamps = read_timestamps(path);
    if (!stamps.files.empty()) timed.pictures = named_pictures(folder, stamps.files);
    if (stamps.captured.size() != timed.pictures.size())
      throw Error(fmt::format("{}: there are {} times for {} pictures in {}", path.string(),
                              stamps.captured.size(), timed.pictures.size(), folder.string()));
    timed.captured = std::move(stamps.captured);
  }
  if (timed.pictures.empty()) throw Error(fmt::format("{} holds no pictures", folder.string()));
  if (!timed.captured.empty()) return timed;
  timed.times_from = TimesFrom::stated_rate;
  const auto rate = options.rate_hz ? options.rate_hz : description.rate_hz;
  if (!rate && description.period) {
    timed.captured = steady_times(timed.pictures.size(), *description.period);
  } else if (rate || own.stated_rate_hz) {
    timed.captured = steady_times(timed.pictures.size(), rate ? *rate : *own.stated_rate_hz);
  } else if (own.assumed_rate_hz) {
    timed.times_from = TimesFrom::assumed_rate;
    timed.captured = steady_times(timed.pictures.size(), *own.assumed_rate_hz);
  } else {
    throw Error(
        fmt::format("{} says nothing of time: add timestamps.csv, or rate_hz to recording.toml, or "
                    "--rate",
                    sidecars.string()));
  }
  return timed;
}

void show(TimedPictures timed, FoundRecording& found) {
  found.times_from = timed.times_from;
  found.data = timed.pictures;
  std::sort(found.data.begin(), found.data.end());
  found.frames = [pictures = std::move(timed.pictures), captured = std::move(timed.captured)] {
    return open_pictures(pictures, captured);
  };
}

FoundRecording find_image_folder(const fs::path& folder, const OpenOptions& options) {
  if (!fs::is_directory(folder))
    throw Error(fmt::format("{} is no folder; a recording is a folder of pictures", folder.string()));
  FoundRecording found;
  found.description = read_description(folder);
  found.labels = folder / "labels.csv";
  const fs::path images = fs::is_directory(folder / "images") ? folder / "images" : folder;
  show(timed_pictures(images, pictures_in(images), folder, found.description, options, {}), found);
  return found;
}

}  // namespace relock
