// The microfacet parameters of the rough materials, and the terms of scattering by a distribution
// of normals at one pair of directions.
#pragma once

#include "math/microfacet.h"
#include "scene/bsdf/eight_points.h"
#include "scene/texture/scalar_texture.h"

#include <optional>
#include <utility>

namespace mlt {

/// The parameters `distribution`, `alpha`, `alpha_u`, `alpha_v` and `sample_visible`.
std::vector<Parameter> rough_surface_parameters();

/// A distribution of normals whose roughness may vary over the surface.
class RoughSurface {
 public:
  explicit RoughSurface(Params& params);

  Microfacet at(const SurfacePoint& at) const {
    const SurfacePoint* one = &at;
    const auto [u, v] = alphas<double>(&one);
    return {type_, u, v, sample_visible_};
  }
  /// That of eight points, for GGX.
  Ggx<Float8> ggx(const SurfacePoint* const* at) const {
    const Float8 least = number<Float8>(Microfacet::min_alpha);
    const auto [u, v] = alphas<Float8>(at);
    return {max(least, u), max(least, v)};
  }
  /// The distribution of mean roughness.
  Microfacet typical() const {
    return {type_, alpha_u_.mean(), alpha_v_ ? alpha_v_->mean() : alpha_u_.mean(), sample_visible_};
  }

  /// A lower bound of alpha().
  double least_alpha() const {
    const bool constant = alpha_u_.is_constant() && (!alpha_v_ || alpha_v_->is_constant());
    return constant ? std::min(typical().alpha_u(), typical().alpha_v()) : 0;
  }
  /// The smaller one of the two roughnesses.
  double alpha(const SurfacePoint& point) const {
    const Microfacet microfacet = at(point);
    return std::min(microfacet.alpha_u(), microfacet.alpha_v());
  }

 private:
  template <class F>
  std::pair<F, F> alphas(const SurfacePoint* const* at) const {
    const F u = alpha_u_.eval<F>(at);
    return {u, alpha_v_ ? alpha_v_->eval<F>(at) : u};
  }

  MicrofacetType type_;
  bool sample_visible_;
  ScalarTexture alpha_u_;
  std::optional<ScalarTexture> alpha_v_;  ///< Empty if it is alpha_u.
};

/// Whether eight points of this distribution together are faster, and single precision is enough.
inline bool fits_lanes(const Microfacet& typical) {
  return typical.type() == MicrofacetType::ggx && typical.sample_visible() &&
         std::min(typical.alpha_u(), typical.alpha_v()) >= least_alpha_in_lanes;
}

/// The parameters `distribution`, `alpha` and `sample_visible` of a distribution that is the same
/// everywhere.
std::vector<Parameter> isotropic_microfacet_parameters();
Microfacet isotropic_microfacet_param(Params& params);

/// G1 of one direction: as densities use it (exact), and as BSDF values use it (Microfacet::G).
template <class F>
struct Masking {
  F exact, fit;

  template <class Normals>
  Masking(const Normals& microfacet, const Vec3Of<F>& w, const Vec3Of<F>& h)
      : exact(microfacet.g1(w, h)),
        fit(microfacet.type() == MicrofacetType::ggx ? exact : microfacet.g1_fit(w, h)) {}
};

/// Density of the normal h when it is sampled for the direction `from`, which may be on either side
/// (Heitz & d'Eon 2014, eq. 2; Walter et al. 2007, eq. 24). `g1` is the exact one of `from`.
template <class Normals, class F>
F normal_pdf(const Normals& microfacet, const Vec3Of<F>& from, const Vec3Of<F>& h, F D, F g1) {
  if (microfacet.sample_visible()) return D * g1 * abs(dot(from, h) / from.z);
  return select(g1 > 0, D * h.z, F(0));
}

/// The density of the direction into which `from` is mirrored by h: |dh / dto| = 1 / (4 |from . h|)
/// (Walter et al. 2007, eq. 14).
template <class Normals, class F>
F reflection_pdf(const Normals& microfacet, const Vec3Of<F>& from, const Vec3Of<F>& h, F D, F g1) {
  return normal_pdf(microfacet, from, h, D, g1) / (4 * abs(dot(from, h)));
}

/// Reflection by the normals half-way between two directions: D G, and the densities with which the
/// two are sampled for each other.
template <class F>
struct MicrofacetReflection {
  Vec3Of<F> h;
  F DG, pdf_from_light, pdf_from_camera;

  template <class Normals>
  MicrofacetReflection(const Normals& microfacet, const Vec3Of<F>& wl, const Vec3Of<F>& wc)
      : h(normalize(wl + wc)) {
    const F D = microfacet.D(h);
    const Masking light(microfacet, wl, h), camera(microfacet, wc, h);
    DG = D * (light.fit * camera.fit);
    pdf_from_light = reflection_pdf(microfacet, wl, h, D, light.exact);
    pdf_from_camera = reflection_pdf(microfacet, wc, h, D, camera.exact);
  }
};

/// The direction into which the normal h mirrors `from`; (0, 0, 0) if it faces away.
template <class F>
Vec3Of<F> mirrored(const Vec3Of<F>& from, const Vec3Of<F>& h) {
  return reflect(from, h) * select(dot(from, h) > 0, F(1), F(0));
}
/// As above, with a normal sampled for `from`.
template <class Normals, class F>
Vec3Of<F> mirrored(const Normals& microfacet, const Vec3Of<F>& from, const Vec2Of<F>& u) {
  return mirrored(from, microfacet.sample(from, u));
}

}  // namespace mlt
