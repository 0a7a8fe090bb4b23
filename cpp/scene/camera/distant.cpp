// A meter of the radiance that leaves the scene, far away from it: the mean over the disk that the
// bounding sphere covers, seen along one direction, or the radiance along the ray to one point.
//
// Like the orthographic camera it is a pinhole that is so far away that its rays are parallel in
// single precision. The square of the pixel becomes the disk by the concentric map, which keeps
// ratios of areas. For one point it is a pinhole with a narrow view that stands outside the scene.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/camera/meter.h"
#include "scene/transform/orientation.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

/// Area of a square over that of the disk in it.
constexpr double square_over_disk = 4 / pi;

class DistantMeter final : public ProjectiveCamera {
 public:
  DistantMeter(const Placement& placement, const std::optional<Vec3>& target)
      : ProjectiveCamera(placement, {}, {}), target_(target) {
    pose_.position = target.value_or(nowhere);
  }

  void set_raster(const Raster& raster) override {
    require_one_pixel(*this, raster);
    raster_ = raster;
  }
  void set_bounds(const Bounds& bounds) override {
    setback_ = target_ ? 0 : parallel_distance * bounds.radius;
    pose_.position =
        target_.value_or(bounds.center) - pose_.axes.n * (2 * bounds.radius + setback_);
    set_image_plane(Vec2(target_ ? narrow_view : bounds.radius / setback_));
  }

  Ray ray(const Vec2& raster, const Vec2& u_lens, double time) const override {
    return Camera::ray(raster, u_lens, time);
  }
  Vec3 direction(const SurfacePoint& xk, const Vec2& raster) const override {
    return ProjectiveCamera::direction(xk, 0.5 + 0.5 * sample_disk(raster));
  }
  std::optional<Projection> project(const SurfacePoint& xk, const Vec3& w) const override {
    const auto on_square = ProjectiveCamera::project(xk, w);
    if (!on_square) return std::nullopt;
    const Vec2 on_disk = 2.0 * on_square->raster - 1.0;
    if (!(dot(on_disk, on_disk) < 1)) return std::nullopt;
    return Projection{invert_disk(on_disk), on_square->importance * square_over_disk,
                      on_square->pdf_direction * square_over_disk};
  }

 private:
  static constexpr Vec3 nowhere{std::numeric_limits<double>::quiet_NaN()};

  std::optional<Vec3> target_;
};

ObjectPtr create_distant(Params& params) {
  if (params.has("direction") && params.has("to_world"))
    params.fail("to_world", "and 'direction' exclude each other");
  Placement placement;
  placement.shutter = read_shutter(params);
  placement.axes = params.has("direction")
                       ? Frame::around(direction_param(params, "direction"))
                       : orientation(params, "to_world", matrix_param(params, "to_world"));
  std::optional<Vec3> target;
  if (params.has("target")) target = vector_param(params, "target");
  return std::make_shared<DistantMeter>(placement, target);
}

}  // namespace

Plugin sensor_distant() {
  return {{"sensor", "distant", "A meter of the radiance that leaves the scene in one direction.",
           concat({{{"direction", ParamType::point, no_default, "Where it looks."},
                    {"to_world", ParamType::transform, no_default,
                     "Instead of direction: it looks along the image of the z axis."},
                    {"target", ParamType::point, no_default,
                     "The point that it looks at; the whole scene if not given."}},
                   shutter_parameters()})},
          create_distant};
}

}  // namespace mlt
