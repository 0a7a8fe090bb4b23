// How the shading normal turns along a surface: what derivatives of specular chains need to know.
#pragma once

#include "scene/scene.h"

namespace mlt {

/// d n = normal_gradient * d p for the shading normal n and a move d p across the geometric one.
/// Images that bend the shading normal are not looked at: see Bsdf::bends_normal.
Mat3 normal_gradient(const Scene& scene, const SurfacePoint& at);

}  // namespace mlt
