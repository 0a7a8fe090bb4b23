// A camera whose rays are parallel. The image lies on the plane z = 0 of camera space, which it
// fills from x = -1 to 1; `to_world` scales it.
//
// It is a pinhole so far behind that plane, at parallel_distance, that its rays differ from
// parallel ones by less than the single precision in which meshes are held. So directions are a
// delta up to the precision of positions, and every formula of a pinhole holds: with the distance
// D, A = A_image / D^2 and c = 1 to 2^-48,
//
//   We G = D^2 / A_image * cos / D^2 = cos / A_image,
//
// which is the importance of a delta of direction: uniform over the image's area (Veach 1997,
// sec. 8.3). Surfaces behind the plane are invisible, and block nothing.
#include "base/registry.h"
#include "scene/camera/projective.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class Orthographic final : public ProjectiveCamera {
 public:
  Orthographic(const Placement& placement, const Vec2& half)
      : ProjectiveCamera(placement, {}, {}), middle_(placement.position), half_(half) {}

  void set_raster(const Raster& raster) override {
    raster_ = raster;
    stand_back(std::max(half_.x, half_.y));
  }
  void set_bounds(const Bounds& bounds) override {
    stand_back(std::max({bounds.radius + length(middle_ - bounds.center), half_.x, half_.y}));
  }

  Ray ray(const Vec2& raster, const Vec2& u_lens, double time) const override {
    return Camera::ray(raster, u_lens, time);
  }

 private:
  void stand_back(double size) {
    setback_ = parallel_distance * size;
    pose_.position = middle_ - pose_.axes.n * setback_;
    const double aspect = static_cast<double>(raster_.full_size.x) / raster_.full_size.y;
    set_image_plane(Vec2(half_.x, half_.y / aspect) / setback_);
  }

  Vec3 middle_;  ///< Middle of the image, when the shutter opens.
  Vec2 half_;    ///< Half the width and height of a square image.
};

Vec2 half_size(const Mat4& to_world) {
  return {length(Vec3(to_world[0])), length(Vec3(to_world[1]))};
}

ObjectPtr create_orthographic(Params& params) {
  const Placement placement = read_placement(params);
  const std::vector<Mat4>& steps = placement.motion.steps();
  const Vec2 half = half_size(steps[0]);
  for (const Mat4& step : steps)
    if (glm::length(half_size(step) - half) > 1e-6 * glm::length(half))
      params.fail("to_world", "zooms; the image of an orthographic camera has one size");
  constexpr double most = 1e30;
  if (!(std::min(half.x, half.y) > 1 / most && std::max(half.x, half.y) < most))
    params.fail("to_world", "scales the image to nothing, or to more than 1e30");
  auto camera = std::make_shared<Orthographic>(placement, half);
  camera->set_clipping(read_clipping(params));
  return camera;
}

}  // namespace

Plugin sensor_orthographic() {
  return {{"sensor",
           "orthographic",
           "A camera whose rays are parallel.",
           concat({placement_parameters(), clipping_parameters()}),
           {"focus_distance"}},
          create_orthographic};
}

}  // namespace mlt
