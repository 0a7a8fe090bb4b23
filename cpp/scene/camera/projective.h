// The ideal camera that projects through a lens onto a plane: a pinhole if the lens has no extent,
// otherwise a thin lens that is sharp at one distance (Kolb et al. 1995, "A realistic camera model
// for computer graphics", sec. 3; Potmesil & Chakravarty 1981).
//
// In camera space the lens is at the origin, z looks into the scene, y is up and x points to the
// LEFT of the image, as in Mitsuba. A raster position stands for the point (X, Y, 1) of the plane
// at unit distance; rays from anywhere on the lens for this raster position meet in f (X, Y, 1),
// where f is the focus distance.
//
// With A the area that the image takes on the plane at unit distance and c = w_z the cosine at the
// lens, dA = f^2 dw / c^3 on the focus plane, which the image fills with area A f^2. So a uniform
// raster position has the density 1 / (A c^3) in solid angle and 1 / (A c^4) in projected solid
// angle, and the importance that integrates to 1 (Veach 1997, sec. 8.3; Pharr et al., PBRT 3rd ed.,
// sec. 16.1.1) is
//
//   We(xk -> w) = 1 / (A_lens A c^4)       (without A_lens for the delta position of a pinhole).
#pragma once

#include "scene/camera/placement.h"

namespace mlt {

/// Sizes of the scene from which on rays are parallel in single precision.
inline constexpr double parallel_distance = 0x1p24;

class ProjectiveCamera : public PlacedCamera {
 public:
  /// The scene's parameters of the field of view.
  struct View {
    enum class Axis { x, y, diagonal, smaller, larger };
    double fov = 0;  ///< Full angle in radians, along `axis`.
    Axis axis = Axis::x;
    Vec2 principal_offset{0};  ///< Shift of the optical axis, as a fraction of the image size.

    /// Half the image's width and height at unit distance; `aspect` is width / height.
    Vec2 half_size(double aspect) const;
  };
  struct Lens {
    double radius = 0;  ///< 0: a pinhole.
    double focus_distance = 1;
  };

  ProjectiveCamera(const Placement& placement, const View& view, const Lens& lens);

  void set_raster(const Raster& raster) override;

  PositionSample sample_position(const Vec2& u, double time) const override;
  double pdf_position(const SurfacePoint& xk) const override;
  Vec2 invert_position(const SurfacePoint& xk) const override;
  Vec3 direction(const SurfacePoint& xk, const Vec2& raster) const override;
  Ray ray(const Vec2& raster, const Vec2& u_lens, double time) const override {
    if (lens_.radius > 0 || moves() || clips()) return Camera::ray(raster, u_lens, time);
    const Vec2 plane = (raster - to_raster_offset_) * from_raster_scale_;
    return {pose_.position, pose_.axes.to_world(normalize(Vec3(plane, 1))), time, infinity,
            surroundings()};
  }
  std::optional<Projection> project(const SurfacePoint& xk, const Vec3& w) const override;
  bool delta_position() const override { return lens_.radius == 0; }
  std::optional<SurfacePoint> move_on_lens(const SurfacePoint& xk, const Vec2& by) const override;
  double lens_radius() const override { return lens_.radius; }
  std::optional<SurfacePoint> hit_lens(const Ray& ray) const override;

 protected:
  /// The full image reaches from -half to half on the plane at unit distance, before the principal
  /// offset.
  void set_image_plane(const Vec2& half);

 private:
  static SurfacePoint point_at(const Vec3& p, const Frame& axes, double time);
  /// The position of xk on the lens, in camera space; 0 for a pinhole.
  Vec2 lens_point(const SurfacePoint& xk) const {
    return lens_.radius == 0 ? Vec2(0) : lens_offset(xk);
  }
  Vec2 lens_offset(const SurfacePoint& xk) const;

  View view_;
  Lens lens_;
  // raster = (X, Y) * to_raster_scale_ + to_raster_offset_
  Vec2 to_raster_scale_{-1}, to_raster_offset_{0}, from_raster_scale_{-1};
  double image_area_ = 1;  ///< A
};

/// The parameters of the field of view.
std::vector<Parameter> field_of_view_parameters();
ProjectiveCamera::View read_view(Params& params);
/// The parameters `near_clip` and `far_clip`; without them nothing is clipped.
std::vector<Parameter> clipping_parameters();
ClippingPlanes read_clipping(Params& params);
/// The parameters of placement, field of view and principal point.
std::vector<Parameter> view_parameters();
ProjectiveCamera::View read_shifted_view(Params& params);
std::shared_ptr<ProjectiveCamera> make_projective(Params& params,
                                                  const ProjectiveCamera::View& view,
                                                  const ProjectiveCamera::Lens& lens);

}  // namespace mlt
