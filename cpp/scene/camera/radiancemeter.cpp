// A meter of the radiance along one ray: a pinhole whose field of view is so narrow that its
// directions differ by less than the single precision of rays in waves, and every formula of a
// pinhole holds. All algorithms find its light but light tracing, none of whose walks comes there.
#include "base/registry.h"
#include "scene/camera/meter.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

class RadianceMeter final : public ProjectiveCamera {
 public:
  explicit RadianceMeter(const Placement& placement) : ProjectiveCamera(placement, {}, {}) {}

  void set_raster(const Raster& raster) override {
    raster_ = raster;
    require_one_pixel(*this, raster);
    set_image_plane(Vec2(narrow_view));
  }
};

Placement read_ray(Params& params) {
  if (!params.has("origin") && !params.has("direction")) return read_placement(params);
  if (params.has("to_world"))
    params.fail("to_world", "and 'origin' with 'direction' exclude each other");
  for (const char* name : {"origin", "direction"})
    if (!params.has(name)) params.fail(name, "is needed too: they are given together");
  Placement placement = read_placement(params);
  placement.position = vector_param(params, "origin");
  placement.axes = Frame::around(direction_param(params, "direction"));
  return placement;
}

ObjectPtr create_radiancemeter(Params& params) {
  return std::make_shared<RadianceMeter>(read_ray(params));
}

}  // namespace

Plugin sensor_radiancemeter() {
  return {{"sensor", "radiancemeter", "A meter of the radiance along one ray.",
           concat({placement_parameters(),
                   {{"origin", ParamType::point, no_default,
                     "With direction, instead of to_world: where the ray starts."},
                    {"direction", ParamType::point, no_default, "Where it goes."}}})},
          create_radiancemeter};
}

}  // namespace mlt
