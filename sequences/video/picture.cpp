#include "sequences/video/picture.h"

#include <fmt/format.h>

#include <array>
#include <opencv2/core.hpp>
#include <string_view>

#include "core/error.h"
#include "core/opencv.h"

extern "C" {
#include <libavutil/frame.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace relock {
namespace {

AVPixelFormat format_of(const AVFrame& frame) { return static_cast<AVPixelFormat>(frame.format); }

bool is_gray(const AVPixFmtDescriptor& pixels) {
  return pixels.nb_components == 1 && (pixels.flags & (AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BAYER)) == 0;
}

/// Whether black is 0 and white the highest value, rather than 16 and 235 of 255. Grey is taken as it is stored:
/// codings of grey state a range that writers do not keep to.
bool is_full_range(const AVFrame& frame, const AVPixFmtDescriptor& pixels) {
  if (is_gray(pixels) || (pixels.flags & AV_PIX_FMT_FLAG_RGB) != 0) return true;
  if (frame.color_range != AVCOL_RANGE_UNSPECIFIED) return frame.color_range == AVCOL_RANGE_JPEG;
  return std::string_view(pixels.name).substr(0, 4) == "yuvj";
}

int matrix_of(const AVFrame& frame) {
  switch (frame.colorspace) {
    case AVCOL_SPC_BT709:
      return SWS_CS_ITU709;
    case AVCOL_SPC_FCC:
      return SWS_CS_FCC;
    case AVCOL_SPC_SMPTE240M:
      return SWS_CS_SMPTE240M;
    case AVCOL_SPC_BT2020_NCL:
    case AVCOL_SPC_BT2020_CL:
      return SWS_CS_BT2020;
    default:
      return SWS_CS_ITU601;
  }
}

}  // namespace

void PictureMaker::FreeScaler::operator()(SwsContext* scaler) const { sws_freeContext(scaler); }

Image PictureMaker::picture(const AVFrame& frame) {
  const AVPixFmtDescriptor* pixels = av_pix_fmt_desc_get(format_of(frame));
  if (!pixels) throw Error("its pixels are of no kind that is known");
  const bool as_stored = !turn_.transposed && !turn_.mirrored_x && !turn_.mirrored_y;
  if (format_of(frame) == AV_PIX_FMT_GRAY8 && as_stored && frame.linesize[0] > 0)
    return {frame.data[0],
            {frame.width, frame.height},
            PixelFormat::gray8,
            static_cast<std::size_t>(frame.linesize[0])};
  convert(frame, is_gray(*pixels) ? PixelFormat::gray8 : PixelFormat::bgr8);
  return upright();
}

void PictureMaker::convert(const AVFrame& frame, PixelFormat format) {
  const AVPixelFormat from = format_of(frame);
  const AVPixelFormat to = format == PixelFormat::gray8 ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_BGR24;
  // Without ACCURATE_RND and BITEXACT the values depend on the machine's vector instructions.
  constexpr int flags = SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT;
  scaler_.reset(sws_getCachedContext(scaler_.release(), frame.width, frame.height, from, frame.width,
                                     frame.height, to, flags, nullptr, nullptr, nullptr));
  if (!scaler_) throw Error(fmt::format("its pixels ({}) cannot be converted", av_get_pix_fmt_name(from)));
  const int* matrix = sws_getCoefficients(matrix_of(frame));
  const int full = is_full_range(frame, *av_pix_fmt_desc_get(from)) ? 1 : 0;
  constexpr int unity = 1 << 16;
  sws_setColorspaceDetails(scaler_.get(), matrix, full, matrix, 1, 0, unity, unity);

  // The converter writes whole vectors: rows need room behind them.
  const int type = format == PixelFormat::gray8 ? CV_8UC1 : CV_8UC3;
  padded_.create(frame.height + 1, (frame.width + 63) / 32 * 32, type);
  converted_ = padded_(cv::Rect(0, 0, frame.width, frame.height));
  const std::array<std::uint8_t*, 4> rows{converted_.data};
  const std::array<int, 4> strides{static_cast<int>(converted_.step)};
  sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, rows.data(), strides.data());
}

Image PictureMaker::upright() {
  cv::Mat turned_picture = converted_;
  if (turn_.transposed) {
    cv::transpose(converted_, upright_);
    turned_picture = upright_;
  }
  if (turn_.mirrored_x || turn_.mirrored_y) {
    const int axes = !turn_.mirrored_x ? 0 : !turn_.mirrored_y ? 1 : -1;  // as cv::flip counts them
    cv::flip(turned_picture, turn_.transposed ? turned_picture : upright_, axes);
    turned_picture = turn_.transposed ? turned_picture : upright_;
  }
  return view(turned_picture);
}

}  // namespace relock
