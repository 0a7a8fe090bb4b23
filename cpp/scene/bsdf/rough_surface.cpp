#include "scene/bsdf/rough_surface.h"

namespace mlt {
namespace {

/// Whether the roughness is given along both axes.
bool anisotropic(const Params& params) { return params.has("alpha_u") || params.has("alpha_v"); }

Parameter microfacet_type_parameter() {
  return choice_parameter("distribution", "beckmann",
                          "Distribution of the microfacet normals; ggx has longer tails.",
                          {"beckmann", "ggx"});
}

Parameter sample_visible_parameter() {
  return {"sample_visible", ParamType::boolean, true,
          "Sample only normals that are visible from the given direction: less noise."};
}

MicrofacetType microfacet_type_param(Params& params) {
  return params.text("distribution") == "ggx" ? MicrofacetType::ggx : MicrofacetType::beckmann;
}

}  // namespace

std::vector<Parameter> isotropic_microfacet_parameters() {
  return {microfacet_type_parameter(),
          {"alpha", ParamType::real, 0.1,
           "Roughness: about the root mean square slope of the microfacets."},
          sample_visible_parameter()};
}

Microfacet isotropic_microfacet_param(Params& params) {
  const double alpha = params.real_in("alpha", 0, 10);
  return {microfacet_type_param(params), alpha, alpha, params.boolean("sample_visible")};
}

std::vector<Parameter> rough_surface_parameters() {
  return {microfacet_type_parameter(),
          {"alpha", ParamType::texture, 0.1,
           "Roughness: about the root mean square slope of the microfacets."},
          {"alpha_u", ParamType::texture, no_default,
           "Roughness along the tangent (optional; together with alpha_v, in place of alpha)."},
          {"alpha_v", ParamType::texture, no_default,
           "Roughness across the tangent (optional; together with alpha_u, in place of alpha)."},
          sample_visible_parameter()};
}

RoughSurface::RoughSurface(Params& params)
    : type_(microfacet_type_param(params)),
      sample_visible_(params.boolean("sample_visible")),
      alpha_u_(scalar_param(params, anisotropic(params) ? "alpha_u" : "alpha")) {
  if (anisotropic(params)) alpha_v_ = scalar_param(params, "alpha_v");
}

}  // namespace mlt
