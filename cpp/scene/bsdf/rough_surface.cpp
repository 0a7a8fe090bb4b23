#include "scene/bsdf/rough_surface.h"

namespace mlt {
namespace {

/// Whether the roughness is given along both axes.
bool anisotropic(const Params& params) { return params.has("alpha_u") || params.has("alpha_v"); }

Microfacet constant(Params& params, double alpha_u, double alpha_v) {
  return {microfacet_type_param(params), alpha_u, alpha_v, params.boolean("sample_visible")};
}

bool is_texture(Params& params, const std::string& name) {
  const ObjectPtr* object = std::get_if<ObjectPtr>(&params.value(name));
  const auto* texture = object ? dynamic_cast<const Texture*>(object->get()) : nullptr;
  return texture && !texture->spectrum(SpectrumUse::unbounded);
}

}  // namespace

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

RoughSurface::RoughSurface(Params& params) : constant_(constant(params, 1, 1)) {
  const bool two = anisotropic(params);
  const std::string u = two ? "alpha_u" : "alpha", v = two ? "alpha_v" : "alpha";
  alpha_u_ = texture_param(params, u);
  alpha_v_ = texture_param(params, v);
  if (is_texture(params, u) || is_texture(params, v)) return;
  constant_ = constant(params, alpha_u_->mean().x, alpha_v_->mean().x);
  alpha_u_ = alpha_v_ = nullptr;
}

Microfacet RoughSurface::textured(const SurfacePoint& at) const {
  const double alpha_u = alpha_u_->eval_scalar(at);
  const double alpha_v = alpha_v_ == alpha_u_ ? alpha_u : alpha_v_->eval_scalar(at);
  return {constant_.type(), alpha_u, alpha_v, constant_.sample_visible()};
}

}  // namespace mlt
