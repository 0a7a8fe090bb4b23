// An image without the light that one group of a render alone has found in a pixel. J. Buisine, S.
// Delepoulle, C. Renaud, "Firefly removal in Monte Carlo rendering with adaptive median of means",
// EGSR 2021: of the M groups, sorted by their brightness, those in the middle are averaged. How
// many are left out on both sides, c = floor(G M / 2), depends on their Gini coefficient
//
//   G = 2 sum_i i x_i / (M sum_i x_i) - (M + 1) / M,
//
// which is 0 where all have the same value, so that the mean stays, and (M - 1) / M where one has
// all the light, so that the median is left. It is biased, and consistent: as the groups agree,
// G goes to 0.
#pragma once

#include "rendering/integrator.h"

namespace mlt {

/// c of groups whose brightnesses are sorted, the smallest first.
int left_out(const std::vector<float>& sorted);

/// The adaptive median of means over the groups of one rendering.
Image adaptive_median(const std::vector<Image>& groups);

/// The image without fireflies; needs as much memory as one image per group.
Image without_fireflies(const Rendering& rendering);

}  // namespace mlt
