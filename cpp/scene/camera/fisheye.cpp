// An equidistant fisheye: the distance from the middle of the image is proportional to the angle
// theta with the axis, up to half the field of view on the circle in the smaller side of the image.
// The image outside of the circle is black.
//
// With h half the field of view and the circle's radius R in pixels, the distance is
// r = R theta / h, and r dr = (R / h)^2 theta dtheta where the solid angle is sin(theta) dtheta:
// there are (R / h)^2 theta / sin(theta) pixels per steradian.
#include "base/registry.h"
#include "scene/camera/panoramic.h"

namespace mlt {
namespace {

class FisheyeCamera final : public PanoramicCamera {
 public:
  FisheyeCamera(const Placement& placement, double half) : PanoramicCamera(placement), half_(half) {
    constexpr double all_around = -1 + 1e-12;  // Straight behind is on the whole circle.
    least_cosine_ = std::max(std::cos(half), all_around);
  }

  void set_raster(const Raster& raster) override {
    raster_ = raster;
    middle_ = 0.5 * Vec2(raster.full_size);
    per_radian_ = std::min(middle_.x, middle_.y) / half_;
  }

 private:
  Vec3 look(const Vec2& position) const override {
    const Vec2 from_middle = (position - middle_) / per_radian_;
    const double theta = glm::length(from_middle);
    if (!(theta < half_)) return {0, 0, -1};
    const double scale = theta > 0 ? std::sin(theta) / theta : 1;
    return {-from_middle.x * scale, -from_middle.y * scale, std::cos(theta)};
  }
  std::optional<Sight> find(const Vec3& w) const override {
    if (w.z < least_cosine_) return std::nullopt;
    const double sine = std::hypot(w.x, w.y), theta = std::atan2(sine, w.z);
    const double scale = sine > 0 ? theta / sine : 1;
    return Sight{middle_ - Vec2(w.x, w.y) * (scale * per_radian_), sqr(per_radian_) * scale};
  }

  double half_;            ///< Half the field of view, in radians.
  Vec2 middle_{0};         ///< The middle of the whole image.
  double per_radian_ = 1;  ///< Pixels per radian from the middle.
};

ObjectPtr create_fisheye(Params& params) {
  const double degrees = params.real("fov");
  if (!(degrees > 0 && degrees <= 360))
    params.fail("fov", fmt::format("is {:f}, but must lie between 0 and 360 degrees", degrees));
  return std::make_shared<FisheyeCamera>(read_placement(params), 0.5 * degrees * degree);
}

}  // namespace

Plugin sensor_fisheye() {
  return {
      {"sensor", "fisheye", "An equidistant fisheye: a round image, black outside of the circle.",
       concat({placement_parameters(),
               {{"fov", ParamType::real, 180.0,
                 "Field of view in degrees across the circle, up to 360."}}})},
      create_fisheye};
}

}  // namespace mlt
