// The edge by which a mutation connects the new vertices to the rest of the path.
#pragma once

#include "mutation/path_state.h"
#include "path/walk.h"

namespace mlt {

/// Tests the visibility of the edge between vertices i - 1 and i of y, which has been evaluated:
/// target = 0 if they do not see each other. What surfaces let pass is a part of the terms.
inline void test_visibility(const Scene& scene, int i, PathState& y, RayCounts& rays) {
  if (!(y.target > 0) || scene.has_passages()) return;
  if (!Walker{scene, y.path.time, rays}.sees(y[i - 1].at, y[i].at)) y.target = 0;
}

}  // namespace mlt
