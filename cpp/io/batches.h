// Sensors of the type `batch`: several views that lie beside each other on one film, as in Mitsuba
// 3. Each view is a sensor of the scene like those at its top.
#pragma once

#include "base/registry.h"
#include "io/node.h"

namespace mlt {

/// The scene with the sensors inside of batches in the place of these. Each has the batch's film,
/// as wide as its part of it. Throws SceneError for a batch without sensors and for a film whose
/// width they cannot share.
Node without_batches(const Node& scene, const Registry& registry);

}  // namespace mlt
