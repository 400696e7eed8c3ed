#include "sequences/simulator/preview.h"

#include <fmt/format.h>

#include <optional>

#include "core/error.h"
#include "sequences/simulator/draft.h"
#include "sequences/simulator/h264.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace relock::simulator {
namespace {

// An MP4 keeps the time to the next frame in 32 bits: with nanoseconds, a gap of two seconds would not fit.
constexpr int kTicksPerSecond = 1'000'000;
constexpr std::int64_t kLongestGap = 1800LL * kTicksPerSecond;

struct CloseFormat {
  void operator()(AVFormatContext* format) const {
    avio_closep(&format->pb);
    avformat_free_context(format);
  }
};

}  // namespace

struct PreviewWriter::File {
  File(const std::filesystem::path& path, Size picture, double rate_hz)
      : name(path.string()),
        draft(path),
        encoder(
            {.picture = picture, .rate_hz = rate_hz, .ticks_per_second = kTicksPerSecond, .for_file = true}) {
    AVFormatContext* made = nullptr;
    if (avformat_alloc_output_context2(&made, nullptr, "mp4", nullptr) < 0)
      throw Error("the installed libavformat cannot write MP4");
    format.reset(made);
    made->flags |= AVFMT_FLAG_BITEXACT;  // no date and no version in the file
    AVStream* stream = avformat_new_stream(made, nullptr);
    avcodec_parameters_from_context(stream->codecpar, &encoder.context());
    stream->time_base = {1, kTicksPerSecond};
    stream->avg_frame_rate = encoder.context().framerate;
    if (avio_open(&made->pb, ("file:" + draft.path().string()).c_str(), AVIO_FLAG_WRITE) < 0 ||
        avformat_write_header(made, nullptr) < 0)
      fail();
  }

  [[noreturn]] void fail() const {
    throw Error(fmt::format("{} cannot be written; is the disk full, or its folder not there?", name));
  }

  std::int64_t ticks_of(Time captured) {
    if (!first) first = captured;
    const std::int64_t ticks = ((captured - *first).count() + 500) / 1000;
    if (last >= 0 && (ticks <= last || ticks - last > kLongestGap))
      throw Error(fmt::format("{}: a frame at {:.6f} s cannot follow one at {:.6f} s", name,
                              1e-6 * static_cast<double>(ticks), 1e-6 * static_cast<double>(last)));
    return last = ticks;
  }

  std::string name;
  Draft draft;
  H264Encoder encoder;
  std::unique_ptr<AVFormatContext, CloseFormat> format;
  std::optional<Time> first;
  std::int64_t last = -1;
};

PreviewWriter::PreviewWriter(const std::filesystem::path& path, Size picture, double rate_hz)
    : file_(std::make_unique<File>(path, picture, rate_hz)) {}
PreviewWriter::~PreviewWriter() = default;

void PreviewWriter::add(const cv::Mat& picture, Time captured) {
  AVPacket& packet = file_->encoder.encode(picture, file_->ticks_of(captured));
  AVFormatContext* format = file_->format.get();
  packet.stream_index = 0;
  packet.duration =
      av_rescale_q(1, av_inv_q(file_->encoder.context().framerate), {1, kTicksPerSecond});  // of the last
  av_packet_rescale_ts(&packet, {1, kTicksPerSecond}, format->streams[0]->time_base);
  if (av_write_frame(format, &packet) < 0 || format->pb->error < 0) file_->fail();
}

void PreviewWriter::finish() {
  AVFormatContext* format = file_->format.get();
  if (file_->last < 0) throw Error(fmt::format("{}: a video needs a frame", file_->name));
  if (av_write_trailer(format) < 0 || avio_closep(&format->pb) < 0) file_->fail();
  file_->draft.put_in_place();
}

}  // namespace relock::simulator
