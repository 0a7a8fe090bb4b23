// The two measures for densities of a path's vertices: the product-area measure dA, and |f| dA with
//
//   |f(x)| = |f_0| G_0 |f_1| ... G_{k-1} |f_k|,   |f_i| the largest component of f_i.
//
// In the second one a density is the quotient p / |f|, formed vertex by vertex: the G of an edge
// that was sampled cancels, and a direction that was sampled by the BSDF leaves the quotient of its
// density and its value. So the product does not overflow, whatever the scale of the scene and the
// length of the path. Only the part of the path that was replaced needs to be evaluated: |f| of the
// rest is a common factor of q(x -> y) / L*(y) and q(y -> x) / L*(x).
//
// In a measure the density of x_j, sampled from its neighbour x_i, is the coefficient at x_i times
// step(i, j); the edge that technique s joins contributes the factor joint(s).
#pragma once

#include "path/path_terms.h"

#include <algorithm>

namespace mlt {

struct AreaMeasure {
  const PathTerms& x;

  double step(int i, int j) const { return x[std::min(i, j)].G; }
  double joint(int) const { return 1; }
};

struct ContributionMeasure {
  const PathTerms& x;

  double step(int i, int) const { return x[i].inverse_f; }
  double joint(int s) const {
    if (s == 0) return x[0].inverse_f;
    if (s > x.edges()) return x[s - 1].inverse_f;
    return x[s - 1].inverse_f * x[s].inverse_f / x[s - 1].G;
  }
};

/// The factor of a density of vertices c ... b that are not sampled one by one.
inline double unsampled(const AreaMeasure&, int /*c*/, int /*b*/) { return 1; }
inline double unsampled(const ContributionMeasure& in, int c, int b) {
  double p = in.x[c].inverse_f;
  for (int i = c; i < b; ++i) p *= in.x[i + 1].inverse_f / in.x[i].G;
  return p;
}

/// Density of x_i made by a light walk.
template <class Measure>
double from_light(const Measure& in, int i) {
  return i == 0 ? in.x[0].from_light : in.x[i - 1].vertex.pdf_from_light * in.step(i - 1, i);
}
/// Density of x_i made by a camera walk.
template <class Measure>
double from_camera(const Measure& in, int i) {
  return i == in.x.edges() ? in.x[i].from_camera
                           : in.x[i + 1].vertex.pdf_from_camera * in.step(i + 1, i);
}

/// Density of vertices first ... end - 1, summed over the techniques that join them to each other
/// or to their neighbours: sum_s l_first ... l_{s-1} joint(s) c_s ... c_{end-1}, with the densities
/// l and c of light and camera walks. Technique 0 counts `hit_light` times.
template <class Measure>
double total_density(const Measure& in, int first, int end, double hit_light = 1,
                     const ExtraTechnique& extra = {}) {
  const auto joint = [&](int s) {
    const double count = (can_sample(in.x, s) ? 1 : 0) + (s == extra.s ? extra.count : 0);
    return count > 0 ? count * in.joint(s) : 0;
  };
  double walk = 1;  // density of the vertices before i
  double sum = joint(first) * (first == 0 ? hit_light : 1);
  for (int i = first; i < end; ++i) {
    walk *= from_light(in, i);
    sum = sum * from_camera(in, i) + (i == 0 ? in.x.direct : walk) * joint(i + 1);
  }
  return sum;
}
/// P(x) = sum over s of p_{s,t}(x), the density of all techniques together.
template <class Measure>
double total_density(const Measure& in, const ExtraTechnique& extra = {}) {
  return total_density(in, 0, in.x.edges() + 1, 1, extra);
}

/// p_{0,k+1}(x) + p_{1,k}(x), the density of the two techniques of path tracing, which does not
/// join the lens to a light; and of the one of refracted_light.h.
template <class Measure>
double path_tracing_density(const Measure& in, const ExtraTechnique& refracted = {}) {
  const PathTerms& x = in.x;
  double sum = can_sample(x, 0) ? in.joint(0) * from_camera(in, 0) : 0;
  if (x.edges() > 1 && can_sample(x, 1)) sum += x.direct * in.joint(1);
  for (int i = 1; i <= x.edges(); ++i) {
    sum *= from_camera(in, i);
    if (i == 1 && refracted.count > 0)
      sum += refracted.count * from_light(in, 0) * from_light(in, 1) * in.joint(2);
  }
  return sum;
}

}  // namespace mlt
