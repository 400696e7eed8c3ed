#include "sequences/simulator/h264.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/error.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace relock::simulator {
namespace {

constexpr const char* kEvenQuality =
    "20";  // x264's constant rate factor: hardly to be told from the original

int even(int side) { return side + side % 2; }

void set_rate(AVCodecContext& codec, double kbps) {
  codec.bit_rate = std::llround(1000 * kbps);
  // A live link holds little back: no half second may have more bits than the link carries in that time.
  codec.rc_max_rate = codec.bit_rate;
  codec.rc_buffer_size = static_cast<int>(codec.bit_rate / 2);
}

}  // namespace

void H264Encoder::Free::operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
void H264Encoder::Free::operator()(AVFrame* frame) const { av_frame_free(&frame); }
void H264Encoder::Free::operator()(AVPacket* packet) const { av_packet_free(&packet); }
void H264Encoder::Free::operator()(SwsContext* scaler) const { sws_freeContext(scaler); }

H264Encoder::H264Encoder(const H264Plan& plan)
    : plan_(plan), frame_(av_frame_alloc()), packet_(av_packet_alloc()) {
  open();
  frame_->format = AV_PIX_FMT_YUV420P;
  frame_->width = codec_->width;
  frame_->height = codec_->height;
  frame_->colorspace = codec_->colorspace;
  frame_->color_range = codec_->color_range;
  const Size size = plan_.picture;
  scaler_.reset(sws_getContext(codec_->width, codec_->height, AV_PIX_FMT_BGR24, codec_->width, codec_->height,
                               AV_PIX_FMT_YUV420P, SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT, nullptr,
                               nullptr, nullptr));
  if (!scaler_ || av_frame_get_buffer(frame_.get(), 0) < 0)
    throw Error(fmt::format("pictures of {}x{} cannot be made ready for H.264", size.width, size.height));
}

void H264Encoder::open() {
  av_log_set_level(AV_LOG_QUIET);  // relock says itself what is wrong, and once
  const AVCodec* encoder = avcodec_find_encoder_by_name("libx264");
  if (!encoder)
    throw Error(
        "the installed libavcodec cannot encode H.264: it comes without libx264; install one that has it, or "
        "set h264_kbps to 0 and ask for no preview");
  codec_.reset(avcodec_alloc_context3(encoder));
  codec_->width = even(plan_.picture.width);
  codec_->height = even(plan_.picture.height);
  codec_->pix_fmt = AV_PIX_FMT_YUV420P;
  codec_->colorspace = AVCOL_SPC_SMPTE170M;  // what sws_getContext makes unless it is told otherwise
  codec_->color_range = AVCOL_RANGE_MPEG;
  codec_->time_base = {1, static_cast<int>(plan_.ticks_per_second)};
  codec_->framerate = av_d2q(plan_.rate_hz, 100000);
  codec_->gop_size = std::max(1, static_cast<int>(std::lround(2 * plan_.rate_hz)));
  codec_->max_b_frames = 0;
  codec_->thread_count = 1;  // with more, the bytes depend on how many
  if (plan_.for_file) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  if (plan_.kbps > 0) set_rate(*codec_, plan_.kbps);
  AVDictionary* options = nullptr;
  av_dict_set(&options, "preset", "veryfast", 0);
  av_dict_set(&options, "tune", "zerolatency", 0);
  if (!(plan_.kbps > 0)) av_dict_set(&options, "crf", kEvenQuality, 0);
  const int code = avcodec_open2(codec_.get(), encoder, &options);
  av_dict_free(&options);
  if (code < 0)
    throw Error(fmt::format("libx264 does not take pictures of {}x{} at {} Hz and {} kbit/s",
                            plan_.picture.width, plan_.picture.height, plan_.rate_hz, plan_.kbps));
}

void H264Encoder::convert(const cv::Mat& picture) {
  const Size size = plan_.picture;
  if (picture.type() != CV_8UC3 || picture.cols != size.width || picture.rows != size.height)
    throw Error(fmt::format("this picture is {}x{} of {} channels and those before it {}x{} of 3",
                            picture.cols, picture.rows, picture.channels(), size.width, size.height));
  // The converter reads whole vectors: rows need room behind them.
  padded_.create(frame_->height + 1, (frame_->width + 63) / 32 * 32, CV_8UC3);
  cv::Mat inside = padded_(cv::Rect(0, 0, frame_->width, frame_->height));
  cv::copyMakeBorder(picture, inside, 0, frame_->height - picture.rows, 0, frame_->width - picture.cols,
                     cv::BORDER_REPLICATE);
  const std::array<const std::uint8_t*, 4> rows{padded_.data};
  const std::array<int, 4> strides{static_cast<int>(padded_.step)};
  // The encoder may still hold the frame's memory, to predict from.
  if (av_frame_make_writable(frame_.get()) < 0) throw Error("there is no memory left for a video frame");
  sws_scale(scaler_.get(), rows.data(), strides.data(), 0, frame_->height, frame_->data, frame_->linesize);
}

AVPacket& H264Encoder::encode(const cv::Mat& picture, std::int64_t ticks) {
  convert(picture);
  frame_->pts = ticks;
  av_packet_unref(packet_.get());
  if (avcodec_send_frame(codec_.get(), frame_.get()) < 0 ||
      avcodec_receive_packet(codec_.get(), packet_.get()) < 0)
    throw Error(fmt::format("libx264 could not encode the picture at {} ticks", ticks));
  return *packet_;
}

}  // namespace relock::simulator
