// The exposure that suits a picture, for who has not chosen one.
#pragma once

#include "image/image.h"

namespace mlt {

/// The stops that show 95 % of the pixels of a linear image below white, from -16 to 16: 0 if that
/// many are black. A pixel counts by its brightest colour; alpha, NaN and infinity do not count,
/// and fireflies are too few to matter.
double fitting_exposure(const Image& image);

}  // namespace mlt
