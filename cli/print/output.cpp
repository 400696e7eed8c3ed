#include "cli/print/output.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/print/draw.h"
#include "core/error.h"

namespace relock {
namespace {

constexpr double kMmPerInch = 25.4, kPointsPerInch = 72;
constexpr double kPointsPerMm = kPointsPerInch / kMmPerInch;
constexpr double kMostDots = 200e6;         // of a page: four bytes each while it is drawn
constexpr double kMostDotsAcross = 30'000;  // Cairo takes 32767
constexpr double kLeastDetailDots = 2;

using SurfacePtr = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using ContextPtr = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

cairo_status_t append(void* content, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(content)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void check_status(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw Error("there is not enough memory to draw this sheet");
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(fmt::format("Cairo cannot draw this sheet: {}", cairo_status_to_string(status)));
}

void draw_page(cairo_surface_t* surface, const Page& page, double units_per_mm) {
  const ContextPtr context(cairo_create(surface), cairo_destroy);
  cairo_scale(context.get(), units_per_mm, units_per_mm);
  draw(context.get(), page);
  cairo_show_page(context.get());
  check_status(cairo_status(context.get()));
}

void finish(cairo_surface_t* surface) {
  cairo_surface_finish(surface);
  check_status(cairo_surface_status(surface));
}

std::string pdf_of(const std::vector<Page>& pages) {
  std::string content;
  const SurfacePtr surface(cairo_pdf_surface_create_for_stream(append, &content, 1, 1),
                           cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "relock marker");
  // The date would make every file another one.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  for (const Page& page : pages) {
    cairo_pdf_surface_set_size(surface.get(), page.width_mm * kPointsPerMm, page.height_mm * kPointsPerMm);
    draw_page(surface.get(), page, kPointsPerMm);
  }
  finish(surface.get());
  return content;
}

std::string svg_of(const Page& page) {
  std::string content;
  const SurfacePtr surface(cairo_svg_surface_create_for_stream(append, &content, page.width_mm * kPointsPerMm,
                                                               page.height_mm * kPointsPerMm),
                           cairo_surface_destroy);
  draw_page(surface.get(), page, kPointsPerMm);
  finish(surface.get());
  return content;
}

cv::Mat dots_of(const Page& page, double dpi) {
  const double dots_per_mm = dpi / kMmPerInch;
  const double width = std::ceil(page.width_mm * dots_per_mm - 1e-6);
  const double height = std::ceil(page.height_mm * dots_per_mm - 1e-6);
  if (width * height > kMostDots || std::max(width, height) > kMostDotsAcross)
    throw Error(
        fmt::format("at {} dpi a page has {:.0f} x {:.0f} dots, more than fit into memory; lower --dpi", dpi,
                    width, height));
  const SurfacePtr surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)),
      cairo_surface_destroy);
  draw_page(surface.get(), page, dots_per_mm);
  cairo_surface_flush(surface.get());
  const cv::Mat4b drawn(cairo_image_surface_get_height(surface.get()),
                        cairo_image_surface_get_width(surface.get()),
                        reinterpret_cast<cv::Vec4b*>(cairo_image_surface_get_data(surface.get())),
                        static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get())));
  cv::Mat channels[4], coloured;
  cv::split(drawn, channels);
  const auto same = [&](int a, int b) { return cv::norm(channels[a], channels[b], cv::NORM_INF) == 0; };
  if (same(0, 1) && same(1, 2)) return channels[0];
  cv::merge(channels, 3, coloured);
  return coloured;
}

std::uint32_t crc_of(std::string_view bytes) {  // of PNG, its annex D
  std::uint32_t crc = 0xffffffff;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xedb88320 ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

/// The chunk that says how large a dot is; neither OpenCV nor Cairo writes it.
std::string size_of_dots(double dpi) {
  const auto per_metre = static_cast<std::uint32_t>(std::lround(1000 * dpi / kMmPerInch));
  const std::string chunk = "pHYs" + big_endian(per_metre) + big_endian(per_metre) + '\1';
  return big_endian(9) + chunk + big_endian(crc_of(chunk));
}

std::string png_of(const Page& page, double dpi) {
  std::vector<unsigned char> encoded;
  if (!cv::imencode(".png", dots_of(page, dpi), encoded)) throw Error("this OpenCV cannot write PNG");
  constexpr std::size_t kHeader = 8 + 25;  // the signature and the chunk IHDR, which comes first
  std::string content(encoded.begin(), encoded.end());
  return content.insert(kHeader, size_of_dots(dpi));
}

/// Width of its narrowest ring, gap or cell.
double finest_mm(const PlacedMarker& marker) {
  const auto* ring = std::get_if<RingMarker>(&marker.design.form);
  if (ring == nullptr) return marker.sheet_mm() / std::get<MarkerCells>(marker.design.form).side;
  double finest = 1, last = -1;
  for (const Annulus& slot : ring->geometry.slots) {
    finest = std::min({finest, slot.width(), slot.inner - last});
    last = slot.outer;
  }
  return finest * marker.size_mm / 2;
}

void check_dots(const std::vector<Page>& pages, double dpi) {
  if (!(dpi >= 20 && dpi <= 4800)) throw Error(fmt::format("--dpi is {}; it must be from 20 to 4800", dpi));
  for (const Page& page : pages)
    for (const PlacedMarker& marker : page.markers)
      if (const double dots = finest_mm(marker) * dpi / kMmPerInch; dots < kLeastDetailDots)
        throw Error(fmt::format(
            "{}: its finest part is {:.2g} dots wide at {} dpi, and 2 are needed; raise --dpi or --size",
            marker.design.name, dots, dpi));
}

}  // namespace

PrintFormat print_format(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (ending == ".pdf") return PrintFormat::pdf;
  if (ending == ".svg") return PrintFormat::svg;
  if (ending == ".png") return PrintFormat::png;
  throw Error(fmt::format("{} must end in .pdf, .svg or .png", file.string()));
}

std::vector<std::string> printed(const std::vector<Page>& pages, PrintFormat format, double dpi) {
  if (format == PrintFormat::pdf) return {pdf_of(pages)};
  if (format == PrintFormat::png) check_dots(pages, dpi);
  std::vector<std::string> files;
  for (const Page& page : pages)
    files.push_back(format == PrintFormat::svg ? svg_of(page) : png_of(page, dpi));
  return files;
}

}  // namespace relock
