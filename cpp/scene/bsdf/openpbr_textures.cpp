#include "scene/bsdf/openpbr_textures.h"

#include "base/registry.h"
#include "scene/bsdf/lobes.h"

#include <glm/exponential.hpp>

namespace mlt {

Plugin texture_scale();

std::vector<Parameter> openpbr_parameters() {
  const Triple rayleigh{1, 0.5, 0.25};
  return {
      {"base_weight", ParamType::texture, 1.0, "Factor of `base_color`."},
      {"base_color", ParamType::texture, 0.8, "Colour of the diffuse base, or of the metal."},
      {"base_diffuse_roughness", ParamType::texture, 0.0, "Roughness of the diffuse base."},
      {"base_metalness", ParamType::texture, 0.0, "Between a dielectric (0) and a metal (1)."},
      {"specular_weight", ParamType::emission, 1.0,
       "Factor of the base's reflectance at normal incidence."},
      {"specular_color", ParamType::texture, 1.0,
       "Factor of the dielectric's reflection from above; a metal's tint near its silhouette."},
      {"specular_roughness", ParamType::texture, 0.3, "Roughness; alpha is its square."},
      {"specular_roughness_anisotropy", ParamType::texture, 0.0,
       "How much highlights are stretched along u."},
      {"specular_ior", ParamType::real, 1.5, "Index of refraction of the dielectric."},
      {"transmission_weight", ParamType::texture, 0.0,
       "Between an opaque (0) and a clear dielectric (1)."},
      {"transmission_color", ParamType::texture, 1.0,
       "What is left of white light after `transmission_depth`; a factor of the refraction if that "
       "is 0."},
      {"transmission_depth", ParamType::real, 0.0, "See `transmission_color`; a length."},
      {"transmission_scatter", ParamType::reflectance, 0.0,
       "Scattering coefficient of the inside, times `transmission_depth`."},
      {"transmission_scatter_anisotropy", ParamType::real, 0.0,
       "Mean cosine of that scattering, -1 to 1."},
      {"transmission_dispersion_scale", ParamType::real, 0.0,
       "How much the index depends on the wavelength, 0 to 1; in spectral scenes alone."},
      {"transmission_dispersion_abbe_number", ParamType::real, 20.0,
       "Abbe's number where that is 1."},
      {"subsurface_weight", ParamType::texture, 0.0,
       "Between a diffuse base (0) and scattering inside of the solid (1)."},
      {"subsurface_color", ParamType::texture, 0.8,
       "Colour of what is scattered inside. In a solid, its mean."},
      {"subsurface_radius", ParamType::real, 1.0, "Mean free path inside; a length."},
      {"subsurface_radius_scale", ParamType::radiance, rayleigh, "Factors of it for R, G and B."},
      {"subsurface_scatter_anisotropy", ParamType::real, 0.0,
       "Mean cosine of that scattering; of a thin wall, what goes through less what comes back."},
      {"fuzz_weight", ParamType::texture, 0.0, "How much fibres cover everything."},
      {"fuzz_color", ParamType::texture, 1.0, "Colour of the fibres."},
      {"fuzz_roughness", ParamType::texture, 0.5, "From upright fibres (0) to dust (1)."},
      {"coat_weight", ParamType::texture, 0.0, "How much a clear coat covers the base."},
      {"coat_color", ParamType::texture, 1.0,
       "What the coat leaves of light that crosses it twice."},
      {"coat_roughness", ParamType::texture, 0.0, "Roughness of the coat; alpha is its square."},
      {"coat_roughness_anisotropy", ParamType::texture, 0.0,
       "How much the coat's highlights are stretched along u."},
      {"coat_ior", ParamType::real, 1.6, "Index of refraction of the coat."},
      {"coat_darkening", ParamType::real, 1.0,
       "How much light that the coat reflects back darkens the base, 0 to 1."},
      {"emission_luminance", ParamType::real, 0.0,
       "Radiance of a shape that is given no emitter; 1 is 1 cd/m^2."},
      {"emission_color", ParamType::texture, 1.0, "Factor of it."},
      {"thin_film_weight", ParamType::texture, 0.0, "How much a thin film covers the base."},
      {"thin_film_thickness", ParamType::real, 0.5, "Thickness of the film, in micrometres."},
      {"thin_film_ior", ParamType::real, 1.4, "Index of refraction of the film."},
      {"geometry_opacity", ParamType::texture, 1.0, "Share of the light that meets the surface."},
      {"geometry_thin_walled", ParamType::boolean, false,
       "The surface is a sheet with nothing inside, such as paper or a bubble."}};
}

OpenPbrTextures::OpenPbrTextures(Params& params)
    : base_color(texture_param(params, "base_color")),
      specular_color(texture_param(params, "specular_color")),
      transmission_color(texture_param(params, "transmission_color")),
      subsurface_color(texture_param(params, "subsurface_color")),
      coat_color(texture_param(params, "coat_color")),
      fuzz_color(texture_param(params, "fuzz_color")),
      base_weight(scalar_param(params, "base_weight")),
      base_diffuse_roughness(scalar_param(params, "base_diffuse_roughness")),
      base_metalness(scalar_param(params, "base_metalness")),
      specular_weight(unbounded_texture_param(params, "specular_weight")),
      specular_roughness(scalar_param(params, "specular_roughness")),
      specular_roughness_anisotropy(scalar_param(params, "specular_roughness_anisotropy")),
      transmission_weight(scalar_param(params, "transmission_weight")),
      subsurface_weight(scalar_param(params, "subsurface_weight")),
      coat_weight(scalar_param(params, "coat_weight")),
      coat_roughness(scalar_param(params, "coat_roughness")),
      coat_roughness_anisotropy(scalar_param(params, "coat_roughness_anisotropy")),
      fuzz_weight(scalar_param(params, "fuzz_weight")),
      fuzz_roughness(scalar_param(params, "fuzz_roughness")),
      thin_film_weight(scalar_param(params, "thin_film_weight")),
      geometry_opacity(scalar_param(params, "geometry_opacity")),
      specular_ior(params.real_in("specular_ior", 1e-3, 1e3)),
      coat_ior(params.real_in("coat_ior", 1e-3, 1e3)),
      coat_darkening(params.real_in("coat_darkening", 0, 1)),
      thin_film_thickness(params.real_in("thin_film_thickness", 0, 1e3)),
      thin_film_ior(params.real_in("thin_film_ior", 1e-3, 1e3)),
      subsurface_anisotropy(params.real_in("subsurface_scatter_anisotropy", -1, 1)),
      tints_glass(params.real_in("transmission_depth", 0, 1e12) == 0) {}

double OpenPbrTextures::relative_ior(double outside) const {
  const double ratio = specular_ior / outside;
  if (!specular_weight.is_constant()) return ratio;
  const double F0 = sqr((ratio - 1) / (ratio + 1));
  const double e = std::copysign(std::sqrt(std::min(specular_weight.mean() * F0, 0.99)), ratio - 1);
  return (1 + e) / (1 - e);
}

namespace {

/// "Translucent base": mu_t = -ln T / depth, mu_s = S / depth.
SolidInside translucent_inside(Params& params, const OpenPbrTextures& textures) {
  const double depth = params.real("transmission_depth");
  const Color left = glm::max(textures.transmission_color->mean(), Color(1e-6));
  const Color scattering = color_param(params, "transmission_scatter") / depth;
  const Color absorption = -glm::log(left) / depth - scattering;
  return {scattering, absorption - Color(std::min(0.0, min_component(absorption))),
          std::clamp(params.real_in("transmission_scatter_anisotropy", -1, 1), -0.99, 0.99)};
}

/// "Subsurface": the albedo by van de Hulst's formula (Kulla & Conty 2017).
SolidInside subsurface_inside(Params& params, const OpenPbrTextures& textures) {
  const double g = std::clamp(textures.subsurface_anisotropy, -0.99, 0.99);
  const Color C = textures.subsurface_color->mean();
  const Color s = 4.09712 + 4.20863 * C - glm::sqrt(9.59217 + 41.6808 * C + 17.7126 * C * C);
  const Color albedo = (1.0 - s * s) / (1.0 - g * s * s);
  const Color path = glm::max(
      params.real_in("subsurface_radius", 0, 1e12) * color_param(params, "subsurface_radius_scale"),
      Color(1e-6));
  return {albedo / path, (1.0 - albedo) / path, g};
}

/// The share `t` of the one, the rest of the other.
SolidInside mixed(const SolidInside& a, const SolidInside& b, double t) {
  const double scattered_a = t * luminance(a.scattering),
               scattered_b = (1 - t) * luminance(b.scattering);
  return {
      t * a.scattering + (1 - t) * b.scattering, t * a.absorption + (1 - t) * b.absorption,
      a.g * first_share(scattered_a, scattered_b) + b.g * first_share(scattered_b, scattered_a)};
}

}  // namespace

ObjectPtr openpbr_glow(Params& params) {
  const double luminance = params.real_in("emission_luminance", 0, 1e12);
  const TexturePtr color = texture_param(params, "emission_color");
  if (luminance == 0) return nullptr;
  const Plugin plugin = texture_scale();
  Params scaled(plugin.schema, params.where());
  scaled.set("scale", luminance, params.where());
  scaled.add("texture", std::const_pointer_cast<Texture>(color), params.where());
  return make_object(plugin, scaled);
}

std::optional<SolidInside> openpbr_inside(Params& params, const OpenPbrTextures& textures) {
  const SolidInside subsurface = subsurface_inside(params, textures);
  SolidInside translucent;
  if (!textures.tints_glass) translucent = translucent_inside(params, textures);
  const double T = textures.transmission_weight.mean(),
               S = (1 - T) * textures.subsurface_weight.mean();
  if (S > 0) return mixed(translucent, subsurface, first_share(T, S));
  if (T > 0 && !textures.tints_glass) return translucent;
  return std::nullopt;
}

}  // namespace mlt
