#include "sequences/simulator/canvas_plan.h"

#include <fmt/format.h>

#include "core/toml_table.h"
#include "sequences/description.h"

namespace relock::simulator {

bool is_canvas_file(const std::filesystem::path& file) {
  return parse_toml(file)["preset"].value_or(std::string()) == "canvas";
}

CanvasFile read_canvas_file(const std::filesystem::path& file) {
  const toml::table parsed = parse_toml(file);
  const TomlTable table(parsed, file.string(),
                        {"preset", "target", "seed", "canvas_px", "marker_px", "lengths_px", "angles_deg",
                         "repetitions", "noise", "grey", "blur_in"});
  CanvasFile canvas;
  CanvasPlan& plan = canvas.plan;
  canvas.target = table.word("target").value_or(canvas.target);
  const auto seed = table.value<std::int64_t>("seed", "a whole number");
  if (seed && *seed < 0) table.fail(*table.node("seed"), "seed must be a whole number from 0");
  if (seed) canvas.seed = static_cast<std::uint64_t>(*seed);
  plan.canvas_px = table.value<int>("canvas_px", "a whole number").value_or(plan.canvas_px);
  plan.marker_px = table.positive("marker_px").value_or(plan.marker_px);
  plan.lengths_px = table.numbers("lengths_px", plan.lengths_px);
  plan.angles_deg = table.numbers("angles_deg", plan.angles_deg);
  plan.repetitions = table.value<int>("repetitions", "a whole number").value_or(plan.repetitions);
  plan.noise = table.value<double>("noise", "a number").value_or(plan.noise);
  plan.grey = table.value<double>("grey", "a number").value_or(plan.grey);
  const auto blur_in = table.word("blur_in");
  if (blur_in && *blur_in != "coded" && *blur_in != "light")
    table.fail(*table.node("blur_in"), "blur_in must be one of coded, light");
  if (blur_in) plan.blur_in = *blur_in == "light" ? BlurIn::light : BlurIn::coded;
  return canvas;
}

std::string canvas_file_text(const CanvasFile& canvas) {
  const CanvasPlan& plan = canvas.plan;
  return fmt::format(
      "preset = \"canvas\"\ntarget = {}\nseed = {}\ncanvas_px = {}\nmarker_px = {}\nlengths_px = "
      "[{}]\nangles_deg = [{}]\n"
      "repetitions = {}\nnoise = {}\ngrey = {}\nblur_in = \"{}\"\n",
      toml_string(canvas.target), canvas.seed, plan.canvas_px, plan.marker_px,
      fmt::join(plan.lengths_px, ", "), fmt::join(plan.angles_deg, ", "), plan.repetitions, plan.noise,
      plan.grey, plan.blur_in == BlurIn::light ? "light" : "coded");
}

}  // namespace relock::simulator
