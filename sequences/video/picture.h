#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/image.h"
#include "sequences/video/file.h"

struct AVFrame;
struct SwsContext;

namespace relock {

/// Makes pictures of decoded frames: bgr8, or gray8 where the video is grey. Range and matrix of the colours
/// are those that the video states (else limited range and BT.601, as OpenCV and ffmpeg have it); 0 is black
/// and 255 white; grey is taken as it is stored. The arithmetic is the same on every machine. Pixels are as stored: those of a stream whose
/// pixels are not square are not stretched.
class PictureMaker {
 public:
  explicit PictureMaker(const Turn& turn) : turn_(turn) {}

  /// The picture, valid until the next call or as long as the frame. Throws Error, without the file's name, on
  /// a kind of pixels that cannot be converted.
  Image picture(const AVFrame& frame);

 private:
  struct FreeScaler {
    void operator()(SwsContext* scaler) const;
  };

  void convert(const AVFrame& frame, PixelFormat format);
  Image upright();

  Turn turn_;
  std::unique_ptr<SwsContext, FreeScaler> scaler_;
  cv::Mat padded_, converted_, upright_;
};

}  // namespace relock
