#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace relock::simulator {

class H264Encoder;

/// What the pictures of a camera go through on their way: a video link, if there is one, and then the coding in
/// which they are stored.
struct TransportPlan {
  int jpeg_quality = 90;  ///< 1 to 100, of the files that are stored; 0: PNG, lossless
  double h264_kbps = 0;   ///< bit rate of the link, thousands of bits a second; 0: there is none
};

/// Throws Error naming the part of the plan that is out of range.
void check_transport(const TransportPlan& plan);

/// How names of files of this plan end: ".jpg" or ".png".
std::string_view picture_suffix(const TransportPlan& plan);
/// The bytes of a picture's file; `bytes` is reused. The picture is CV_8UC1 or CV_8UC3 (BGR).
void encode_picture(const cv::Mat& picture, const TransportPlan& plan, std::vector<std::uint8_t>& bytes);

/// A live H.264 link: every picture is encoded and decoded at once, in order, none waiting for a later one. What
/// comes out depends on all pictures before it, so one link serves one flight, from one thread. The same pictures
/// give the same pictures.
class VideoLink {
 public:
  /// `rate_hz`: at which the bits are shared out among the pictures. Throws Error when the installed libavcodec
  /// comes without libx264.
  VideoLink(Size picture, double rate_hz, double kbps);
  ~VideoLink();

  /// The picture, CV_8UC3 of the stated size, as it comes out at the other end, in `out`, which is reused where
  /// it fits and may be the same. Throws Error on a picture of another kind.
  void carry(const cv::Mat& picture, cv::Mat& out);

 private:
  struct Decoder;
  std::unique_ptr<H264Encoder> encoder_;
  std::unique_ptr<Decoder> decoder_;
  Size size_;
  std::int64_t pictures_ = 0;
};

}  // namespace relock::simulator
