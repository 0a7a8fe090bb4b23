// What a shape is given once it is made: a light, a sensor, a motion.
#pragma once

#include "base/params.h"
#include "scene/camera/camera.h"
#include "scene/shape/shape.h"

#include <string>
#include <vector>

namespace mlt {

/// The names under which objects of this family have what they are given once they are made.
std::vector<std::string> attached(const std::string& family);

/// Throws SceneError for a light that is no surface.
void attach_light(Shape& shape, const EmitterPtr& light);
/// Makes the shape the lens of the sensor. Throws SceneError if it moves, or is an instance.
void attach_sensor(Shape& shape, Camera& sensor, Params& params);

/// The shape, or an instance that moves it if its transform is an animation.
ShapePtr moving(const ShapePtr& shape, Params& params);

}  // namespace mlt
