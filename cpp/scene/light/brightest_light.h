// How bright a light may be.
#pragma once

namespace mlt {

/// More, of any quantity of light, could overflow the floats of an image.
constexpr double brightest_light = 1e30;

}  // namespace mlt
