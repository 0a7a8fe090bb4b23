#pragma once

#include "scene/shape/shape.h"

#include <optional>

namespace mlt {

/// The volume inside of a shape: of a sphere, or of a mesh for which the divergence theorem holds:
/// the integral of x_i n_j over it is its volume for i = j, else 0. Cracks between its triangles do
/// not matter. Other shapes have no inside.
std::optional<double> enclosed_volume(const Shape& shape);
inline bool is_closed(const Shape& shape) { return enclosed_volume(shape).has_value(); }

}  // namespace mlt
