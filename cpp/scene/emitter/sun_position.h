// The position of the sun: given as a direction, or computed from a place and a time.
#pragma once

#include "base/params.h"
#include "math/vec.h"

namespace mlt {

/// Parameters of the position, with Mitsuba's names and defaults: Tokyo on an afternoon in July.
std::vector<Parameter> sun_position_parameters();

/// The direction towards the sun in the sky's own space, in which y is up, -z is north and x is
/// east. Throws SceneError if it is below the horizon.
Vec3 read_sun_position(Params& params);

}  // namespace mlt
