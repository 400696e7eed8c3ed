#include "cli/verbs.h"

namespace relock {

int attribute(const AttributeArguments&) { return 0; }

}  // namespace relock
