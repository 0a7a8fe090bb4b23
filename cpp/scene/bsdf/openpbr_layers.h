// How the layers of OpenPBR share the light of one direction above them, and the terms of the
// reflection between two. The specification's albedo scaling f_coat + (1 - E_coat(w_c)) f_base is
// not symmetric in the directions. Here it is, and keeps as much light:
//
//   diffuse base   f (1 - E(wl)) (1 - E(wc)) / (1 - mean of E)   (Kelemen & Szirmay-Kalos 2001)
//   glossy base    f min(1 - E(wl), 1 - E(wc))
//
// The first loses nothing over a white Lambertian, the second nothing over a mirror.
#pragma once

#include "math/ggx.h"
#include "scene/bsdf/openpbr_fuzz.h"
#include "scene/bsdf/openpbr_metal.h"

namespace mlt {

/// The parameters at a point, without colours.
template <class F>
struct OpenPbrPoint {
  F metalness;
  F enters;        ///< The share of the dielectric that light goes into; the rest is diffuse.
  F coat, fuzz;    ///< Weights.
  F gloss, metal;  ///< Factors of the dielectric's and of the metal's reflectance.
  F diffuse_roughness, roughness, coat_roughness, fuzz_roughness;
  Ggx<F> facets, coat_facets;
  F diffuse_scale;  ///< 1 / (1 - mean of E) of all layers above the diffuse base.
};

/// What the layers reflect of light from one direction, each of what comes to it.
template <class F>
struct OpenPbrShares {
  F fuzz, coat, gloss;

  F under_fuzz() const { return 1 - fuzz; }
  F under_coat() const { return (1 - fuzz) * (1 - coat); }
  F under_gloss() const { return (1 - fuzz) * (1 - coat) * (1 - gloss); }
};

/// Values over the colours, and densities, of reflection above the surface.
template <class F>
struct OpenPbrTerms {
  F diffuse_once, diffuse_twice;  ///< As in RoughDiffuseTerms.
  F gloss, fresnel;               ///< The dielectric's, as a factor of Fresnel's reflectance.
  F metal, metal_again;           ///< The metal's, and what its colour gives for light that stays.
  MetalAngle<F> angle;
  F coat, coat_path, fuzz;  ///< coat_path: through the coat, over that at normal incidence.
  F cos_h, cos_l, cos_c;
  F pdf_from_light, pdf_from_camera;

  OpenPbrTerms<double> of_lane(int i) const {
    return {diffuse_once[i],
            diffuse_twice[i],
            gloss[i],
            fresnel[i],
            metal[i],
            metal_again[i],
            angle.of_lane(i),
            coat[i],
            coat_path[i],
            fuzz[i],
            cos_h[i],
            cos_l[i],
            cos_c[i],
            0,
            0};
  }
};

/// sqrt(alpha) of an isotropic surface that loses about as much light in the direction w: at
/// grazing angles the roughness along w counts, along the normal that of all directions.
template <class F>
F roughness_along(const Ggx<F>& facets, const Vec3Of<F>& w) {
  const F mean = number<F>(0.5) * (facets.alpha_u + facets.alpha_v);
  return sqrt(sqrt(sqr(facets.alpha_u * w.x) + sqr(facets.alpha_v * w.y) + sqr(mean * w.z)));
}

}  // namespace mlt
