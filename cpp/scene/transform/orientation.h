// The axes of a transform that only rotates (and may mirror), for cameras and environment maps.
// Scales have no effect there and are dropped.
#pragma once

#include "base/params.h"
#include "math/frame.h"
#include "scene/transform/motion.h"

namespace mlt {

/// The images of the x, y and z axes as an orthonormal frame (left-handed for a mirrored
/// transform). The z axis is kept exactly; the others are made perpendicular to it. Throws
/// SceneError about the parameter `name` if the transform is singular or shears.
Frame orientation(const Params& params, const std::string& name, const Mat4& to_world);

/// The parameter `to_world`, of which every step has an orientation.
Motion turning_motion_param(Params& params);

/// The orientation of a transform that is known to be neither singular nor shearing.
Frame turned_axes(const Mat4& to_world);

}  // namespace mlt
