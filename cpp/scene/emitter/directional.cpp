// Parallel light from infinity, as from a sun of no size. Its radiance is a delta of
// direction, whose coefficient is the irradiance on a surface that faces it.
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/infinite.h"
#include "scene/emitter/lamp_color.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

class DirectionalLight final : public InfiniteEmitter {
 public:
  explicit DirectionalLight(Params& params) : irradiance_(params, "irradiance") {
    const bool given = params.has("direction");
    const std::string name = given ? "direction" : "to_world";
    Vec3 d;
    if (given) {
      if (params.has("to_world")) params.fail("to_world", "and 'direction' exclude each other");
      d = vector_param(params, "direction");
    } else {
      d = transform_vector(matrix_param(params, "to_world"), {0, 0, 1});
    }
    if (!(length(d) > 0) || !std::isfinite(length(d)))
      params.fail(name, "gives a direction without length");
    towards_ = -normalize(d);
  }

  Spectrum eval(const SurfacePoint& x0, const Vec3&) const override { return irradiance_.at(x0); }

  PositionSample sample_position(const Vec2&, double) const override {
    return {point_towards(towards_), 1};
  }
  double pdf_position(const SurfacePoint&) const override { return 1; }
  Vec2 invert_position(const SurfacePoint&) const override { return Vec2(0.5); }

  bool delta() const override { return true; }
  Color power() const override { return irradiance_.mean() * disk_area(); }

 private:
  LampColor irradiance_;
  Vec3 towards_;
};

}  // namespace

Plugin emitter_directional() {
  return make_emitter_plugin<DirectionalLight>(
      "directional", "Parallel light from infinitely far away.",
      {{"irradiance", ParamType::lamp, 1.0, "Power per area perpendicular to the light."},
       {"direction", ParamType::point, no_default, "The direction in which light travels."},
       {"to_world", ParamType::transform, no_default,
        "Instead of direction: light travels along the image of the z axis."}});
}

}  // namespace mlt
