// Evaluation of a proposal y of which only the path is known, such as one made in Python: what C++
// mutations record about their proposals is computed from the vertices alone.
#pragma once

#include "mutation/path_target.h"
#include "path/ray_counts.h"

namespace mlt {

/// The smallest edit that turns x into y.
Edit difference(const Path& x, const Path& y);

/// Whether light can take the edges that touch vertices first ... last: nothing stands in the way,
/// and each delta vertex at one of their ends scatters in the one direction that it can.
bool passable(const Scene& scene, const Path& path, int first, int last, RayCounts& rays);

/// Evaluates y, of which only the path is known; target = 0 also where light cannot take it.
/// Returns the edit that turns x into y; edges of x are taken to be passable.
Edit evaluate_proposal(const PathTarget& target, const PathState& x, PathState& y, RayCounts& rays);

/// Evaluates a path of which only the vertices are known; target = 0 also where light cannot take
/// it.
PathState evaluated(const PathTarget& target, const Path& path, RayCounts& rays);

}  // namespace mlt
