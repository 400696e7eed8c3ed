#include "sequences/video/file.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

namespace relock {
namespace {

std::string reason(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

/// The display matrix of the stream, row by row; null if it has none.
const std::int32_t* display_matrix(const AVStream& stream) {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 31, 100)
  const AVCodecParameters& coded = *stream.codecpar;
  const AVPacketSideData* side =
      av_packet_side_data_get(coded.coded_side_data, coded.nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return side ? reinterpret_cast<const std::int32_t*>(side->data) : nullptr;
#else
  return reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
#endif
}

}  // namespace

Size turned(Size stored, const Turn& turn) {
  return turn.transposed ? Size{stored.height, stored.width} : stored;
}

void VideoFile::CloseFormat::operator()(AVFormatContext* format) const { avformat_close_input(&format); }
void VideoFile::FreePacket::operator()(AVPacket* packet) const { av_packet_free(&packet); }

VideoFile::VideoFile(const std::filesystem::path& path) : name_(path.string()), packet_(av_packet_alloc()) {
  av_log_set_level(AV_LOG_QUIET);  // relock says itself what is wrong, and once
  if (!std::filesystem::is_regular_file(path)) throw Error(fmt::format("{} is no file", name_));
  if (std::filesystem::file_size(path) == 0) throw Error(fmt::format("{} is empty", name_));

  // "file:" keeps a name with a colon in it from being taken for a protocol.
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  AVFormatContext* opened = nullptr;
  const int code = avformat_open_input(&opened, ("file:" + name_).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (code < 0)
    throw Error(fmt::format("{} is no video that can be read, or its beginning or index is missing ({})",
                            name_, reason(code)));
  format_.reset(opened);
  avformat_find_stream_info(opened, nullptr);  // what it could not find out is asked for below

  stream_ = av_find_best_stream(opened, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream_ < 0 || (stream().disposition & AV_DISPOSITION_ATTACHED_PIC) != 0)
    throw Error(fmt::format("{} holds no stream of pictures", name_));
  const AVCodecID coding = stream().codecpar->codec_id;
  if (!avcodec_find_decoder(coding))
    throw Error(fmt::format("{}: the installed libav cannot decode its pictures ({})", name_,
                            coding == AV_CODEC_ID_NONE ? "an unknown coding" : avcodec_get_name(coding)));
  if (stream().codecpar->width <= 0 || stream().codecpar->height <= 0)
    throw Error(fmt::format("{} does not say how large its pictures are, and none can be decoded", name_));
  for (unsigned i = 0; i < opened->nb_streams; ++i)
    if (static_cast<int>(i) != stream_) opened->streams[i]->discard = AVDISCARD_ALL;
}

const AVStream& VideoFile::stream() const { return *format_->streams[stream_]; }

Size VideoFile::picture_size() const {
  return turned({stream().codecpar->width, stream().codecpar->height}, turn());
}

// A point of the stored picture (x, y) is shown at (m0 x + m3 y, m1 x + m4 y), but for a shift.
Turn VideoFile::turn() const {
  const std::int32_t* m = display_matrix(stream());
  if (!m || (m[0] == 0 && m[1] == 0 && m[3] == 0 && m[4] == 0)) return {};
  if (m[1] == 0 && m[3] == 0) return {false, m[0] < 0, m[4] < 0};
  if (m[0] == 0 && m[4] == 0) return {true, m[3] < 0, m[1] < 0};
  throw Error(fmt::format(
      "{} is to be shown turned by an angle that is no quarter turn; make it upright first", name_));
}

bool VideoFile::keeps_times() const { return (format_->iformat->flags & AVFMT_NOTIMESTAMPS) == 0; }

std::int64_t VideoFile::nanoseconds(std::int64_t ticks) const {
  return av_rescale_q(ticks, stream().time_base, AVRational{1, 1'000'000'000});
}

std::optional<std::int64_t> VideoFile::stated_end_ns() const {
  const AVFormatContext& format = *format_;
  if (format.nb_streams != 1 || format.duration <= 0 || format.duration == AV_NOPTS_VALUE) return {};
  if (format.duration_estimation_method != AVFMT_DURATION_FROM_STREAM) return {};  // an estimate
  // Some formats count it from 0 and some from the first picture: this is the least that it can mean.
  return 1000 * format.duration;  // microseconds (AV_TIME_BASE)
}

const AVPacket* VideoFile::read() {
  while (!cut_off_) {
    av_packet_unref(packet_.get());
    const int code = av_read_frame(format_.get(), packet_.get());
    if (code == AVERROR_EOF) return nullptr;
    if (code < 0) {
      cut_off_ = true;
      return nullptr;
    }
    if (packet_->stream_index == stream_ && packet_->size > 0) return packet_.get();
  }
  return nullptr;
}

}  // namespace relock
