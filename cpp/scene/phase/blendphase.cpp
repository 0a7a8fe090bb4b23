// A blend of two phase functions.
#include "base/registry.h"
#include "scene/bsdf/blend.h"
#include "scene/nested.h"

namespace mlt {
namespace {

ObjectPtr create_blend(Params& params) {
  const auto [first, second] = nested_pair<Bsdf>(params, "phase");
  const TexturePtr weight = constant_texture(params.real_in("weight", 0, 1));
  return std::make_shared<Blend>(first, second, weight, 1, params);
}

}  // namespace

Plugin phase_blendphase() {
  return {{"phase",
           "blendphase",
           "A blend of two nested phase functions.",
           {{"weight", ParamType::real, 0.5,
             "Share of the second phase function; that of the first is 1 less it."}}},
          create_blend};
}

}  // namespace mlt
