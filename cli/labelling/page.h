#pragma once

#include <span>
#include <string_view>

namespace relock {

/// A file of the labelling page, as it is in cli/labelling/page/.
struct PageFile {
  std::string_view name;  ///< "page.css"; the page itself is ""
  std::string_view kind;  ///< its media type
  std::string_view text;
};
std::span<const PageFile> label_page();

}  // namespace relock
