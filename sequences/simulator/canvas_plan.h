#pragma once

#include <filesystem>
#include <string>

#include "sequences/simulator/canvas.h"

namespace relock::simulator {

/// A canvas experiment as a file states it.
struct CanvasFile {
  CanvasPlan plan;
  std::string target = "ring:01";  ///< as `relock marker` takes it
  std::uint64_t seed = 1;
};

/// Whether a plan file is one of a canvas: it says preset = "canvas".
bool is_canvas_file(const std::filesystem::path& file);
/// TOML: preset = "canvas", target, seed, and the quantities of CanvasPlan by their names; blur_in is "coded" or "light".
/// Throws Error with file, line and column.
CanvasFile read_canvas_file(const std::filesystem::path& file);
/// The file that `read_canvas_file` makes the same of.
std::string canvas_file_text(const CanvasFile& canvas);

}  // namespace relock::simulator
