#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/image.h"

struct AVCodecContext;
struct AVFrame;
struct AVPacket;
struct SwsContext;

namespace relock::simulator {

/// How pictures are coded as H.264.
struct H264Plan {
  Size picture;         ///< px; an odd side is made even by repeating the last row or column
  double rate_hz = 30;  ///< that the encoder plans with
  std::int64_t ticks_per_second = 90000;  ///< unit of the times that it is given
  double kbps = 0;                        ///< 0: as many as an even quality takes
  bool for_file = false;                  ///< with the parameters apart, as an MP4 wants them
};

/// Codes pictures by libx264, each at once: no picture waits for a later one, as on a live link. One thread and
/// no clock: the same pictures give the same bytes.
class H264Encoder {
 public:
  /// Throws Error when the installed libavcodec comes without libx264.
  explicit H264Encoder(const H264Plan& plan);

  /// The packet of `picture`, CV_8UC3 of the stated size, shown at `ticks`, more than the last one's. Valid until
  /// the next call. Throws Error on another picture.
  AVPacket& encode(const cv::Mat& picture, std::int64_t ticks);
  const AVCodecContext& context() const { return *codec_; }

 private:
  struct Free {
    void operator()(AVCodecContext* codec) const;
    void operator()(AVFrame* frame) const;
    void operator()(AVPacket* packet) const;
    void operator()(SwsContext* scaler) const;
  };
  void open();
  void convert(const cv::Mat& picture);

  H264Plan plan_;
  std::unique_ptr<AVCodecContext, Free> codec_;
  std::unique_ptr<AVFrame, Free> frame_;
  std::unique_ptr<AVPacket, Free> packet_;
  std::unique_ptr<SwsContext, Free> scaler_;
  cv::Mat padded_;
};

}  // namespace relock::simulator
