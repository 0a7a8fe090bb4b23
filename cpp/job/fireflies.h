// An image without the light that one group of a render alone has found in a pixel. J. Buisine, S.
// Delepoulle, C. Renaud, "Firefly removal in Monte Carlo rendering with adaptive median of means",
// EGSR 2021: of the M groups, sorted by their brightness, those in the middle are averaged. How
// many are left out on both sides, c = floor(G M / 2), is told by their Gini coefficient
//
//   G = 2 sum_i i x_i / (M sum_i x_i) - (M + 1) / M,
//
// which is 0 where all have seen the same, so that the mean stays, and (M - 1) / M where one has
// seen all, so that the median is left. It is biased, and consistent: as the groups come to agree,
// G goes to 0.
#pragma once

#include "rendering/integrator.h"

namespace mlt {

/// c of groups whose brightnesses are sorted, the smallest first.
int left_out(const std::vector<float>& sorted);

/// In the memory of as many images as there are groups.
Image without_fireflies(const Rendering& rendering);

}  // namespace mlt
