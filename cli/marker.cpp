// `relock marker`: prints markers at their true size.

#include <fmt/format.h>

#include <algorithm>

#include "cli/files.h"
#include "cli/print/design.h"
#include "cli/print/length.h"
#include "cli/print/output.h"
#include "cli/print/sheet.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

std::vector<Design> designs_of(const MarkerArguments& arguments) {
  std::vector<Design> designs;
  for (const std::string& list : arguments.markers)
    for (const std::string& name : names_in(list)) designs.push_back(design_of(name, arguments.rings));
  return designs;
}

/// An option for rings must not be passed over in silence where it does nothing.
void check_ring_options(const MarkerArguments& arguments, const std::vector<Design>& designs) {
  bool any_ring = false;
  for (const Design& design : designs) {
    const bool ring = design.code && design.round();
    any_ring = any_ring || ring;
    if (arguments.rings.inverted && !ring)
      throw Error(fmt::format("--inverted is for ring markers, and {} is none; print it in a call of its own",
                              design.name));
  }
  if (!any_ring && arguments.rings != RingLook{})
    throw Error("--geometry, --quiet-zone and --soft-border are for ring markers, and there is none");
}

/// Said once for each geometry that needs it.
void tell_unequal_rings(const std::vector<Design>& designs) {
  std::vector<std::string> told;
  for (const Design& design : designs) {
    const auto* ring = std::get_if<RingMarker>(&design.form);
    if (ring == nullptr || equally_wide(ring->geometry)) continue;
    const std::string slots = slots_text(ring->geometry);
    if (std::find(told.begin(), told.end(), slots) != told.end()) continue;
    told.push_back(slots);
    fmt::print(stderr,
               "relock: the rings {} are not equally wide; a reader must be told these radii to read them\n",
               slots);
  }
}

void check_place(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) throw Error(fmt::format("the folder {} does not exist", folder.string()));
  if (fs::exists(file) && !fs::is_regular_file(file))
    throw Error(fmt::format("{} is there and is no file that could be replaced", file.string()));
}

}  // namespace

int marker(const MarkerArguments& arguments) {
  const PrintFormat format = print_format(arguments.out);
  const double size_m = parse_length_m(arguments.size, "--size");
  const std::vector<Design> designs = designs_of(arguments);
  check_ring_options(arguments, designs);
  const auto pages =
      lay_out(designs, {.size_m = size_m, .paper = arguments.paper, .captions = !arguments.no_caption});
  const auto files = printed(pages, format, arguments.dpi);
  for (std::size_t i = 0; i < files.size(); ++i) check_place(numbered(arguments.out, i));
  for (std::size_t i = 0; i < files.size(); ++i) write_file(numbered(arguments.out, i), files[i]);
  tell_unequal_rings(designs);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const bool own_file = i < files.size();
    fmt::print("{}{:.5g} x {:.5g} mm, {} marker{}\n",
               own_file ? numbered(arguments.out, i).string() + ": " : "  ", pages[i].width_mm,
               pages[i].height_mm, pages[i].markers.size(), pages[i].markers.size() == 1 ? "" : "s");
  }
  return 0;
}

}  // namespace relock
