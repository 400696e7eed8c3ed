#pragma once

#include "cli/print/sheet.h"

typedef struct _cairo cairo_t;

namespace relock {

/// Draws the page; the context's unit is the millimetre.
void draw(cairo_t* on, const Page& page);

}  // namespace relock
