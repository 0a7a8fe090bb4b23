// The edge by which a mutation connects the new vertices to the rest of the path.
#pragma once

#include "mutation/path_state.h"
#include "path/walk.h"

namespace mlt {

/// Tests the visibility of the edge between vertices i - 1 and i of y, which has been evaluated,
/// and scales y by it.
inline void scale_by_visibility(const Scene& scene, int i, PathState& y, RayCounts& rays) {
  if (!(y.target > 0)) return;
  const double seen = Walker{scene, y.path.time, rays}.visibility(y[i - 1].at, y[i].at);
  y.rgb *= seen;
  y.target = seen > 0 ? seen * y.target : 0;
}

}  // namespace mlt
