// A camera that sees all around, by longitude (across the image) and latitude: the middle looks
// along +z of camera space, the upper edge is +y. With the shares u and v of the image's width and
// height,
//
//   d = (-sin(phi) sin(theta), cos(theta), cos(phi) sin(theta)),
//   phi = 2 pi (u - 1/2),  theta = pi v,
//
// as the sensor of this name in Mitsuba 0.6, so that an image of the surroundings is an environment
// map. An image of w x h pixels has w h / (2 pi^2 sin(theta)) pixels per steradian.
//
// Positions outside the image stand for directions that are inside as well, so samples are taken
// inside the image alone: it has no border, and filters count as far as they lie inside.
#include "base/registry.h"
#include "scene/camera/panoramic.h"

namespace mlt {
namespace {

class SphericalCamera final : public PanoramicCamera {
 public:
  using PanoramicCamera::PanoramicCamera;

  void set_raster(const Raster& raster) override {
    raster_ = raster;
    raster_.border = 0;
  }

 private:
  Vec3 look(const Vec2& position) const override {
    const double phi = 2 * pi * (position.x / raster_.full_size.x - 0.5),
                 theta = pi * position.y / raster_.full_size.y;
    return {-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta)};
  }
  std::optional<Sight> find(const Vec3& w) const override {
    const double sine = std::hypot(w.x, w.z);
    if (sine == 0) return std::nullopt;
    const Vec2 size(raster_.full_size);
    const double u = std::atan2(-w.x, w.z) / (2 * pi) + 0.5, v = std::atan2(sine, w.y) / pi;
    return Sight{{(u < 1 ? u : 0) * size.x, v * size.y}, size.x * size.y / (2 * pi * pi * sine)};
  }
};

ObjectPtr create_spherical(Params& params) {
  return std::make_shared<SphericalCamera>(read_placement(params));
}

}  // namespace

Plugin sensor_spherical() {
  return {{"sensor", "spherical",
           "A camera that sees all around: longitude across the image, latitude down.",
           placement_parameters()},
          create_spherical};
}

}  // namespace mlt
