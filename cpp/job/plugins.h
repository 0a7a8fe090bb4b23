// All plug-ins of this build.
#pragma once

#include "base/registry.h"

namespace mlt {

/// The registry of all plug-ins; made once, never changed.
const Registry& plugins();

}  // namespace mlt
