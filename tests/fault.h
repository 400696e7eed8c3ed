#pragma once

#include <string>

#include "core/error.h"

namespace relock {

/// The sentence of the Error that `act` ends in; empty if it does not.
template <class Act>
std::string fault_of(const Act& act) {
  try {
    act();
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace relock
