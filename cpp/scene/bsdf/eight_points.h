// Scattering by eight points of one material together (ScatteringLanes). The material is opaque and
// scatters light above it alone. A model of one has, over numbers F that are double or Float8:
//
//   Point      point<F>(at)              what its textures say of the point but colours; at is an
//                                        array of pointers to the points, one for each lane
//   Float8     narrowest(point)          the least roughness (alpha) of its lobes
//   Terms<F>   terms(point, wl, wc)      factors of its colours, and densities
//   Vec3Of<F>  direction(point, from, u) a sample; not above the surface: there is none
//   Colors     colors(at)                what its textures say of colours
//   Spectrum   value(colors, terms)      the BSDF
#pragma once

#include "scene/bsdf/bsdf.h"

namespace mlt {

/// Single precision is not enough for sharper lobes.
constexpr double least_alpha_in_lanes = 0.02;

/// One point, in double precision.
inline void scatter_one(const Bsdf& bsdf, ScatteringLanes& x, int i) {
  const SurfacePoint& at = *x.at[i];
  const Vec3 wc(x.wc[i]);
  const Scattering light = bsdf.scattering(at, Vec3(x.wl[i]), wc, Lobe::smooth);
  x.f_light[i] = light.f;
  x.pdf_light[i] = static_cast<float>(light.pdf_from_camera);
  x.pdf[i] = 0;
  const auto sample = bsdf.sample(at, wc, {x.u_lobe[i], x.u_x[i], x.u_y[i]});
  if (!sample) return;
  const Scattering next = bsdf.scattering(at, sample->to, wc, Lobe::smooth);
  x.to.set(i, Vec3f(sample->to));
  x.f[i] = next.f;
  x.pdf[i] = static_cast<float>(next.pdf_from_camera);
}

template <class Model>
void scatter_eight(const Model& model, ScatteringLanes& x, int first) {
  using Vec3 = Vec3Of<Float8>;
  const auto point = model.template point<Float8>(&x.at[first]);
  const Vec3 wc = x.wc.eight(first), wl = x.wl.eight(first);
  const Vec3 u{x.u_lobe.eight(first), x.u_x.eight(first), x.u_y.eight(first)};
  const Vec3 sampled = model.direction(point, wc, u);
  const auto is_lit = (wl.z > 0) & (wc.z > 0), goes_on = (sampled.z > 0) & (wc.z > 0);
  const Vec3 up(Float8(0), Float8(0), Float8(1));
  const auto light = model.terms(point, select(is_lit, wl, up), select(is_lit, wc, up));
  const Vec3 to = select(goes_on, sampled, up);
  const auto next = model.terms(point, to, select(goes_on, wc, up));
  x.pdf_light.set_eight(first, select(is_lit, light.pdf_from_camera, Float8(0)));
  x.pdf.set_eight(first, select(goes_on, next.pdf_from_camera, Float8(0)));
  x.to.set_eight(first, to);
  const auto is_sharp = model.narrowest(point) < number<Float8>(least_alpha_in_lanes);
  for (int lane = 0, i = first; lane < 8 && i < x.count; ++lane, ++i) {
    if (is_sharp[lane]) {
      scatter_one(model, x, i);
      continue;
    }
    const auto colors = model.colors(*x.at[i]);
    x.f_light[i] = is_lit[lane] ? model.value(colors, light.of_lane(lane)) : Spectrum(0);
    x.f[i] = goes_on[lane] ? model.value(colors, next.of_lane(lane)) : Spectrum(0);
  }
}

template <class Model>
void scatter_by_eight(const Model& model, ScatteringLanes& x) {
  x.fill_up();
  for (int i = 0; i < x.count; i += 8) scatter_eight(model, x, i);
}

}  // namespace mlt
