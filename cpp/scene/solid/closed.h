#pragma once

#include "scene/shape/shape.h"

namespace mlt {

/// Whether a shape has an inside: it is a sphere, or a mesh for which the divergence theorem holds:
/// the integral of x_i n_j over it is its volume for i = j, else 0. Cracks between its triangles do
/// not matter.
bool is_closed(const Shape& shape);

}  // namespace mlt
