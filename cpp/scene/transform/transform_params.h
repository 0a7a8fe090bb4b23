// Vectors and transforms among the parameters of a scene's objects.
#pragma once

#include "base/params.h"
#include "math/vec.h"

namespace mlt {

Vec3 vector_param(Params& params, const std::string& name);
/// A transform; the identity if it has no default and is not given. at_rest() of an animation.
Mat4 matrix_param(Params& params, const std::string& name);

}  // namespace mlt
