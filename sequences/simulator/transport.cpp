#include "sequences/simulator/transport.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/opencv.h"
#include "sequences/simulator/h264.h"
#include "sequences/video/picture.h"

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace relock::simulator {
namespace {

constexpr int kMost_kbps = 1'000'000;
constexpr std::int64_t kTicksPerSecond = 90000;  // as MPEG counts

}  // namespace

void check_transport(const TransportPlan& plan) {
  if (plan.jpeg_quality < 0 || plan.jpeg_quality > 100)
    throw Error(fmt::format("jpeg_quality must be from 1 to 100, or 0 for PNG, not {}", plan.jpeg_quality));
  if (!(plan.h264_kbps == 0 || (plan.h264_kbps >= 1 && plan.h264_kbps <= kMost_kbps)))
    throw Error(
        fmt::format("h264_kbps must be from 1 to {}, or 0 for no link, not {}", kMost_kbps, plan.h264_kbps));
}

std::string_view picture_suffix(const TransportPlan& plan) { return plan.jpeg_quality > 0 ? ".jpg" : ".png"; }

void encode_picture(const cv::Mat& picture, const TransportPlan& plan, std::vector<std::uint8_t>& bytes) {
  const std::string suffix(picture_suffix(plan));
  // The least effort for PNG: noise is not made smaller by more.
  const std::vector<int> options = plan.jpeg_quality > 0
                                       ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, plan.jpeg_quality}
                                       : std::vector<int>{cv::IMWRITE_PNG_COMPRESSION, 1};
  if (!cv::imencode(suffix, picture, bytes, options))
    throw Error(fmt::format("the installed OpenCV cannot write {} files", suffix.substr(1)));
}

struct VideoLink::Decoder {
  struct Free {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
    void operator()(AVFrame* frame_of_it) const { av_frame_free(&frame_of_it); }
  };

  Decoder() : frame(av_frame_alloc()) {
    const AVCodec* h264 = avcodec_find_decoder(AV_CODEC_ID_H264);
    if (!h264) throw Error("the installed libavcodec cannot decode H.264; set h264_kbps to 0");
    codec.reset(avcodec_alloc_context3(h264));
    codec->thread_count = 1;
    codec->flags |= AV_CODEC_FLAG_LOW_DELAY;  // gives each picture at once, and holds none back to reorder
    if (avcodec_open2(codec.get(), h264, nullptr) < 0) throw Error("the decoder of H.264 cannot be opened");
  }

  std::unique_ptr<AVCodecContext, Free> codec;
  std::unique_ptr<AVFrame, Free> frame;
  PictureMaker maker{Turn{}};
};

VideoLink::VideoLink(Size picture, double rate_hz, double kbps)
    : encoder_(std::make_unique<H264Encoder>(H264Plan{picture, rate_hz, kTicksPerSecond, kbps})),
      decoder_(std::make_unique<Decoder>()),
      size_(picture) {}
VideoLink::~VideoLink() = default;

void VideoLink::carry(const cv::Mat& picture, cv::Mat& out) {
  const AVRational rate = encoder_->context().framerate;
  const std::int64_t ticks = av_rescale(pictures_++, kTicksPerSecond * rate.den, rate.num);
  const AVPacket& packet = encoder_->encode(picture, ticks);
  AVCodecContext* codec = decoder_->codec.get();
  if (avcodec_send_packet(codec, &packet) < 0 || avcodec_receive_frame(codec, decoder_->frame.get()) < 0)
    throw Error(fmt::format("picture {} did not come through the video link", pictures_ - 1));
  const cv::Mat whole = read_only_mat(decoder_->maker.picture(*decoder_->frame));
  whole(cv::Rect(0, 0, size_.width, size_.height)).copyTo(out);
}

}  // namespace relock::simulator
