#pragma once

#include <string_view>

namespace relock {

/// A plug-in to start from: the one that a page of docs/ shows. cmake/documented.cmake puts it in here.
struct PluginTemplate {
  std::string_view name;        ///< of the method: to be replaced wherever it stands
  std::string_view class_name;  ///< likewise
  std::string_view source, cmake, commands;
};
extern const PluginTemplate kDetectorTemplate, kTrackerTemplate;

}  // namespace relock
