#pragma once

#include <string>

#include "cli/json_text.h"

namespace relock::reports {

/// The page of cli/report/page/ with its data in it, as one file that needs nothing else. Whatever a name in the data
/// holds stays text: it cannot end the block that it is in, and the page puts it nowhere but into text.
std::string page(const Json& data);

/// The template: HTML with its styles and scripts. Made when relock is built (cmake/report_page.cmake).
extern const char* const kPage;

}  // namespace relock::reports
