// All plug-ins of this build.
#pragma once

#include "base/registry.h"

namespace mlt {

/// Made once, never changed.
const Registry& plugins();

}  // namespace mlt
