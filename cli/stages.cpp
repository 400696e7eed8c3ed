#include "cli/stages.h"

#include <fmt/format.h>

#include "cli/catalogue.h"
#include "cli/drawing.h"
#include "cli/files.h"
#include "cli/plot/plot.h"
#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

Plot plot_of(const Stage& stage, const Chart& chart) {
  Plot plot{.title = stage.sentence, .x = {chart.x}, .y = {chart.y}};
  for (const ChartCurve& curve : chart.curves) {
    PlotCurve line{.name = curve.name, .style = CurveStyle::line};
    for (const Vec2& point : curve.points) line.points.push_back({point.x, point.y});
    plot.curves.push_back(std::move(line));
  }
  return plot;
}

std::filesystem::path write_stage(const Stage& stage, const std::filesystem::path& stem) {
  if (const auto* chart = std::get_if<Chart>(&stage.shown)) {
    const std::filesystem::path file = stem.string() + ".svg";
    draw(plot_of(stage, *chart), file);
    return file;
  }
  const auto& picture = std::get<Picture>(stage.shown);
  if (picture.pixels.empty()) throw Error(fmt::format("the stage \"{}\" shows an empty picture", stage.name));
  const std::filesystem::path file = stem.string() + ".png";
  write_picture(file, read_only_mat(picture.view()));
  return file;
}

bool shows_stages(const Methods& methods, const DetectorEntry& entry) {
  try {
    choose(methods, {entry.name, {}});  // a plug-in that does not survive being made is left out
    const auto detector = entry.make(Options(entry.name, entry.options, {}), 1);
    return dynamic_cast<const ExplainingDetector*>(detector.get()) != nullptr;
  } catch (const Error&) {
    return false;  // it cannot be made without options
  }
}

}  // namespace

std::vector<std::filesystem::path> write_stages(const std::vector<Stage>& stages,
                                                const std::filesystem::path& folder) {
  make_folder(folder);
  std::vector<std::filesystem::path> files;
  for (const Stage& stage : stages)
    files.push_back(write_stage(stage, folder / fmt::format("{}-{}", files.size() + 1, slug(stage.name))));
  return files;
}

std::vector<std::string> explaining_detectors(const Methods& methods) {
  std::vector<std::string> names;
  for (const DetectorEntry& entry : methods.detectors.entries())
    if (shows_stages(methods, entry)) names.push_back(entry.name);
  return names;
}

}  // namespace relock
