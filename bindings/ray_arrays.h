// Many rays at once, as arrays.
#pragma once

#include "bindings.h"

namespace mlt::python {

/// Throws UsageError for the start of a ray, `what` it is called, that is too far away.
void check_start(const Vec3& start, const std::string& what);

/// Intersects rays; returns arrays by name, see Scene.intersect. Throws UsageError for arrays that
/// are not (n, 3), or hold a start that is not finite or a direction without length.
py::dict intersect_rays(const LoadedScene& loaded, const Doubles& starts, const Doubles& directions,
                        double time);

/// Returns (starts, directions) of the rays through raster positions, from the middle of the lens.
py::tuple camera_rays(const LoadedScene& loaded, const Doubles& rasters, double time);

}  // namespace mlt::python
