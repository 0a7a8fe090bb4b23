// The parameters of OpenPBR Surface 1.1, by the specification's names, and what they are at a
// point.
#pragma once

#include "math/ggx.h"
#include "scene/bsdf/bsdf.h"
#include "scene/texture/scalar_texture.h"

namespace mlt {

std::vector<Parameter> openpbr_parameters();

struct OpenPbrTextures {
  explicit OpenPbrTextures(Params& params);

  TexturePtr base_color, specular_color, transmission_color, subsurface_color, coat_color,
      fuzz_color;
  ScalarTexture base_weight, base_diffuse_roughness, base_metalness, specular_weight,
      specular_roughness, specular_roughness_anisotropy, transmission_weight, subsurface_weight,
      coat_weight, coat_roughness, coat_roughness_anisotropy, fuzz_weight, fuzz_roughness,
      thin_film_weight, geometry_opacity;
  double specular_ior, coat_ior, coat_darkening, thin_film_thickness, thin_film_ior,
      subsurface_anisotropy;
  bool tints_glass;  ///< Whether transmission_color is that of the surface, not of its inside.

  bool transmits() const { return !transmission_weight.vanishes(); }
  bool has_subsurface() const { return !subsurface_weight.vanishes(); }
  Spectrum base(const SurfacePoint& at) const {
    return base_weight.eval(at) * base_color->eval(at);
  }

  /// The index of the base over what is above it, where that is `outside`. A constant
  /// specular_weight scales the reflectance at normal incidence by way of the index.
  double relative_ior(double outside) const;
  /// What specular_weight still scales: it is a texture.
  template <class F>
  F gloss(const SurfacePoint* const* at) const {
    return specular_weight.is_constant() ? F(1) : min(F(1), specular_weight.eval<F>(at));
  }
};

/// What fills a solid whose surface refracts light into it: by transmission_depth and
/// transmission_scatter, by subsurface_color and subsurface_radius, or by the mean of both.
std::optional<SolidInside> openpbr_inside(Params& params, const OpenPbrTextures& textures);

/// The radiance by emission_luminance and emission_color; nullptr if that is 0.
ObjectPtr openpbr_glow(Params& params);

/// GGX of a roughness, stretched along the tangent ("Microfacet model").
template <class F>
Ggx<F> openpbr_facets(F roughness, F anisotropy) {
  const F across = 1 - anisotropy, least = number<F>(0.001);
  const F along = sqr(roughness) * sqrt(2 / (1 + sqr(across)));
  return {max(least, along), max(least, across * along)};
}

}  // namespace mlt
