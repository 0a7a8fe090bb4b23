// A blend of two materials, by a weight that may vary over the surface.
#include "base/registry.h"
#include "scene/bsdf/blend.h"
#include "scene/nested.h"

namespace mlt {
namespace {

ObjectPtr create_blend(Params& params) {
  const auto [first, second] = nested_pair<Bsdf>(params, "bsdf");
  return std::make_shared<Blend>(first, second, texture_param(params, "weight"), 1, params);
}

}  // namespace

Plugin bsdf_blendbsdf() {
  Schema schema{"bsdf",
                "blendbsdf",
                "A blend of two nested bsdfs.",
                {{"weight", ParamType::texture, 0.5,
                  "Share of the second bsdf; that of the first is 1 less it."}}};
  schema.reciprocal = false;  // one of them may refract
  return {schema, create_blend};
}

}  // namespace mlt
