#include "core/truth.h"

namespace relock {

std::string_view to_string(Label label) {
  switch (label) {
    case Label::visible:
      return "visible";
    case Label::absent:
      return "absent";
    case Label::unlabelled:
      break;
  }
  return "unlabelled";
}

}  // namespace relock
