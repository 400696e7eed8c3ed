#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/print/sheet.h"

namespace relock {

enum class PrintFormat : std::uint8_t {
  pdf,  ///< all pages in one file
  svg,  ///< a file for each page
  png,  ///< a file for each page, grey, and it says its dots per inch
};

/// By the file's ending. Throws Error for an ending that is none of the three.
PrintFormat print_format(const std::filesystem::path& file);

/// The files' contents, at true size: the same bytes for the same pages. `dpi` is that of PNG, from 20 to
/// 4800. Throws Error when a page has too many dots for memory, and when a ring or a cell is less than two
/// dots wide.
std::vector<std::string> printed(const std::vector<Page>& pages, PrintFormat format, double dpi);

}  // namespace relock
