// The microfacets of rough glass: which of them scatters light from one direction to another, and
// its part in the BSDF and in densities (Walter et al. 2007, sec. 4 and 5). Refraction is written
// for radiance that flows from wl to wc, so that f(wl, wc) / eta_c^2 is symmetric.
#pragma once

#include "math/frame.h"
#include "math/fresnel.h"
#include "scene/bsdf/rough_surface.h"

namespace mlt {

struct GlassFacet {
  bool exists, reflects;
  Vec3 h;            ///< Its normal, above the surface.
  double eta;        ///< n_below / n_above.
  double cosine, F;  ///< The cosine in the thinner medium, and the Fresnel reflectance.
};

/// The facet that scatters from a to b; the same from b to a, bit for bit.
inline GlassFacet glass_facet(const Vec3& a, const Vec3& b, double eta) {
  if (a.z * b.z == 0) return {};
  const bool reflects = same_side(a, b);
  // eqs. 13 and 16, up to the sign and length.
  const Vec3 sum = reflects ? a + b : a.z > 0 ? a + eta * b : b + eta * a;
  if (sum.z == 0) return {};
  const Vec3 h = normalize(sum.z < 0 ? -sum : sum);
  const double cos_a = dot(a, h), cos_b = dot(b, h);
  if (cos_a * a.z <= 0 || cos_b * b.z <= 0) return {};
  // Refraction: in the thinner medium F is well conditioned up to grazing.
  const bool thin_is_above = eta > 1;
  const double cosine = reflects ? 0.5 * dot(sum, h) : (a.z > 0) == thin_is_above ? cos_a : cos_b;
  return {true, reflects, h, eta, cosine, fresnel_dielectric(cosine, eta).reflectance};
}

/// n on the other side over n on the side of w.
inline double eta_on_side(double eta, const Vec3& w) { return w.z > 0 ? 1 / eta : eta; }

/// f of refraction for F = 0 and D G = cos_l cos_c (eq. 21, both eta divided by eta_c).
inline double refraction_jacobian(const GlassFacet& facet, const Vec3& wl, const Vec3& wc) {
  const double l = dot(wl, facet.h), c = dot(wc, facet.h);
  return std::abs(l * c) / sqr(l * eta_on_side(facet.eta, wl) + c);
}

/// Density of `to` if a facet of this kind (reflecting or refracting) is chosen; `D` and `g1` are
/// those of the facet, as seen along `from`.
template <class Distribution>
double facet_pdf(const Distribution& microfacet, const Vec3& from, const Vec3& to,
                 const GlassFacet& facet, double D, double g1) {
  if (facet.reflects) return reflection_pdf(microfacet, from, facet.h, D, g1);
  const double f = dot(from, facet.h), t = dot(to, facet.h);
  // eq. 17, both eta divided by the one on the side of `to`.
  return normal_pdf(microfacet, from, facet.h, D, g1) * std::abs(t) /
         sqr(f * eta_on_side(facet.eta, from) + t);
}

}  // namespace mlt
