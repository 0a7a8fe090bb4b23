#include "scene/texture/uv_transform.h"

#include "scene/texture/texture.h"
#include "scene/transform/transform_params.h"

namespace mlt {

std::vector<Parameter> uv_parameters() {
  return {{"to_uv", ParamType::transform, no_default,
           "Applied to texture coordinates: x, y and the translation of a transform count. "
           "Identity if not given."},
          {"uoffset", ParamType::real, 0.0, "Added to u, after the scale."},
          {"voffset", ParamType::real, 0.0, "Added to v, after the scale."},
          {"uscale", ParamType::real, no_default, "Multiplies u; uvscale if not given."},
          {"vscale", ParamType::real, no_default, "Multiplies v; uvscale if not given."},
          {"uvscale", ParamType::real, 1.0, "Multiplies u and v."}};
}

UvTransform::UvTransform(Params& params) {
  const Mat4 m = matrix_param(params, "to_uv");
  u_ = {m[0][0], m[1][0], m[3][0]};
  v_ = {m[0][1], m[1][1], m[3][1]};
  const double both = params.real("uvscale");
  const double uscale = params.has("uscale") ? params.real("uscale") : both;
  const double vscale = params.has("vscale") ? params.real("vscale") : both;
  u_ = u_ * uscale + Vec3(0, 0, params.real("uoffset"));
  v_ = v_ * vscale + Vec3(0, 0, params.real("voffset"));
}

}  // namespace mlt
