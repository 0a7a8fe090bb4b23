// A meter of the irradiance on the shape that it is nested in: the mean over its surface, on the
// side of the normal. The lens is that surface, and the pixel is the hemisphere above each of its
// points, with the density cos / pi. So the mean radiance over both is the irradiance over pi.
//
// The shape blocks the light that comes to it, as any other: the lens lies above the surface, where
// rays start from it. Walks from lights end on the surface below, and so none hits the lens.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/camera/meter.h"
#include "scene/shape/shape.h"

namespace mlt {
namespace {

class IrradianceMeter final : public Camera {
 public:
  explicit IrradianceMeter(const Shutter& shutter) { shutter_ = shutter; }

  PositionSample sample_position(const Vec2& u, double time) const override {
    PositionSample sample = shape_->sample_position(u);
    SurfacePoint& xk = sample.at;
    xk.p = ray_origin(xk.p, xk.ng, xk.ng, xk.extent);
    xk.shading = Frame::around(xk.ng);
    xk.shape = SurfacePoint::no_shape;
    xk.time = time;
    return sample;
  }
  double pdf_position(const SurfacePoint&) const override { return 1 / shape_->area(); }
  Vec2 invert_position(const SurfacePoint& xk) const override {
    return shape_->invert_position(xk);
  }

  Vec3 direction(const SurfacePoint& xk, const Vec2& raster) const override {
    return xk.shading.to_world(sample_cosine_hemisphere(raster));
  }
  std::optional<Projection> project(const SurfacePoint& xk, const Vec3& w) const override {
    const Vec3 local = xk.shading.to_local(w);
    if (!(local.z > 0)) return std::nullopt;
    return Projection{invert_cosine_hemisphere(local), inv_pi * pdf_position(xk), inv_pi};
  }

  bool delta_position() const override { return false; }
  bool can_be_hit() const override { return false; }
  double response() const override { return pi; }

  void set_shape(const Shape* shape) override {
    if (shape_) throw SceneError(at(where, "sensor '{}' is in a second shape; keep one", type));
    shape_ = shape;
  }
  bool lacks_shape() const override { return !shape_; }
  void set_raster(const Raster& raster) override {
    require_one_pixel(*this, raster);
    raster_ = raster;
  }

 private:
  const Shape* shape_ = nullptr;
};

ObjectPtr create_irradiancemeter(Params& params) {
  return std::make_shared<IrradianceMeter>(read_shutter(params));
}

}  // namespace

Plugin sensor_irradiancemeter() {
  return {{"sensor", "irradiancemeter",
           "A meter of the irradiance on the shape that it is nested in.", shutter_parameters()},
          create_irradiancemeter};
}

}  // namespace mlt
