#pragma once

#include <string>

// gnuplot as a child process. No shell is between, and no file: what it reads and writes is in memory.

namespace relock::figure {

/// Whether it is installed.
bool gnuplot_is_there();

/// What gnuplot writes to its standard output for this script. It is started without the user's settings, so that
/// the same script gives the same bytes. Throws Error when it is not installed, and with its own last words when it
/// fails.
std::string gnuplot(const std::string& script);

}  // namespace relock::figure
