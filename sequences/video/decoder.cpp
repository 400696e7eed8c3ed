#include "sequences/video/decoder.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace relock {
namespace {

bool is_key(const AVFrame& frame) {
#ifdef AV_FRAME_FLAG_KEY
  return (frame.flags & AV_FRAME_FLAG_KEY) != 0;
#else
  return frame.key_frame != 0;
#endif
}

}  // namespace

void VideoDecoder::FreeCodec::operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
void VideoDecoder::FreeFrame::operator()(AVFrame* frame) const { av_frame_free(&frame); }

VideoDecoder::VideoDecoder(const std::filesystem::path& path) : file_(path) {
  const AVCodec* decoder = avcodec_find_decoder(file_.stream().codecpar->codec_id);
  codec_.reset(avcodec_alloc_context3(decoder));
  avcodec_parameters_to_context(codec_.get(), file_.stream().codecpar);
  codec_->pkt_timebase = file_.stream().time_base;
  codec_->thread_count = 1;
  // Of Motion JPEG, libav fills in what is missing and does not say so; this has it give up instead.
  if (codec_->codec_id == AV_CODEC_ID_MJPEG) codec_->err_recognition |= AV_EF_EXPLODE;
  if (avcodec_open2(codec_.get(), decoder, nullptr) < 0)
    throw Error(
        fmt::format("{}: its pictures cannot be decoded; are they encrypted, or is its beginning damaged?",
                    file_.name()));
}

// A frame may be made from others that are shown after it, as far as the decoder reorders. So it looks that far
// ahead: one that is damaged taints those.
std::optional<DecodedFrame> VideoDecoder::next() {
  if (!held_.empty()) held_.pop_front();
  while (held_.size() <= static_cast<std::size_t>(std::max(0, codec_->has_b_frames)) && hold()) continue;
  if (held_.empty()) return {};
  DecodedFrame first = held_.front().decoded;
  for (const Held& later : held_) first.whole = first.whole && later.decoded.whole;
  return first;
}

bool VideoDecoder::hold() {
  FramePointer frame(av_frame_alloc());
  for (;;) {
    const int code = avcodec_receive_frame(codec_.get(), frame.get());
    if (code == AVERROR_EOF) return false;
    if (code == AVERROR(EAGAIN)) {
      feed();
    } else if (code < 0) {
      lose(AV_NOPTS_VALUE);  // it could not use one of the packets that it holds, and does not say which
    } else {
      DecodedFrame decoded{frame.get(), ranks_++, {}, {frame->width, frame->height}, true};
      note_damage(decoded, *frame);
      held_.push_back({std::move(frame), decoded});
      return true;
    }
  }
}

void VideoDecoder::feed() {
  const AVPacket* packet = file_.read();
  // Null tells the decoder that there are no more: the frames that it holds back for reordering come out now.
  if (const int code = avcodec_send_packet(codec_.get(), packet); packet && code < 0) {
    lose(packet->pts);
  } else if (packet && (packet->flags & AV_PKT_FLAG_CORRUPT) != 0) {
    if (packet->pts != AV_NOPTS_VALUE) {
      damaged_.insert(packet->pts);
    } else {
      tainted_ = true;
    }
  }
}

void VideoDecoder::lose(std::int64_t ticks) {
  ++ranks_;
  if (ticks != AV_NOPTS_VALUE) {
    damaged_.insert(ticks);
  } else {
    tainted_ = true;
  }
}

void VideoDecoder::note_damage(DecodedFrame& decoded, const AVFrame& frame) {
  const bool faulty = frame.decode_error_flags != 0 || (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0;
  if (frame.best_effort_timestamp == AV_NOPTS_VALUE) {
    if (faulty || is_key(frame)) tainted_ = faulty;
    decoded.whole = !tainted_;
    return;
  }
  const std::int64_t ticks = frame.best_effort_timestamp;
  decoded.ticks = ticks;
  if (faulty) damaged_.insert(ticks);
  if (is_key(frame) && damaged_.count(ticks) == 0) {
    tainted_ = false;
    afresh_ = ticks;
  }
  const auto damage = damaged_.lower_bound(afresh_);
  decoded.whole = !tainted_ && (damage == damaged_.end() || *damage > ticks);
}

}  // namespace relock
