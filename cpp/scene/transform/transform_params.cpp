#include "scene/transform/transform_params.h"

#include "scene/transform/matrix_rows.h"
#include "scene/transform/motion.h"

namespace mlt {

Vec3 vector_param(Params& params, const std::string& name) {
  const Triple t = params.triple(name);
  return {t[0], t[1], t[2]};
}

Mat4 matrix_param(Params& params, const std::string& name) {
  const Parameter* parameter = params.schema().find(name);
  const bool has_default = !std::holds_alternative<std::monostate>(parameter->default_value);
  if (!has_default && !params.has(name)) return Mat4(1);
  if (const auto* animation = std::get_if<Animation>(&params.value(name)))
    return at_rest(*animation);
  return from_rows(params.matrix(name));
}

}  // namespace mlt
