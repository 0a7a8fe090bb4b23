#include "scene/camera/meter.h"

#include "base/error.h"
#include "scene/transform/transform_params.h"

namespace mlt {

void require_one_pixel(const Camera& sensor, const Raster& raster) {
  const auto refuse = [&](const std::string& need) {
    throw SceneError(
        at(sensor.where, "sensor '{}' measures one value: its film needs {}", sensor.type, need));
  };
  if (raster.size != Vec2i(1) || raster.full_size != Vec2i(1)) refuse("the width and height 1");
  if (raster.border > 0) refuse("the filter 'box', which weights the whole pixel evenly");
}

Vec3 direction_param(Params& params, const std::string& name) {
  const Vec3 d = vector_param(params, name);
  if (!(length(d) > 0) || !std::isfinite(length(d))) params.fail(name, "has no length");
  return normalize(d);
}

}  // namespace mlt
