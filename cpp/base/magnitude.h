// How large the numbers of a scene may be that make rays.
#pragma once

#include <cmath>

namespace mlt {

/// The largest coordinate, entry of a transform, or extinction. Embree takes rays up to 1.8e18,
/// whose squares are the largest floats; a thousandth of that leaves room for sums of coordinates.
constexpr double largest_magnitude = 1e15;

/// Whether a number is too large, or none.
inline bool too_large(double x) { return !(std::abs(x) <= largest_magnitude); }

}  // namespace mlt
