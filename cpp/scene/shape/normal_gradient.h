// The derivative of the shading normal along a surface, for the derivatives of specular chains.
#pragma once

#include "scene/scene.h"

namespace mlt {

/// d n = normal_gradient * d p for the shading normal n and a move d p across the geometric one.
/// Normal and bump maps are ignored: see Bsdf::bends_normal.
Mat3 normal_gradient(const Scene& scene, const SurfacePoint& at);

}  // namespace mlt
