#include "scene/camera/projective.h"

#include "math/warp.h"

namespace mlt {

ProjectiveCamera::ProjectiveCamera(const Placement& placement, const View& view, const Lens& lens)
    : PlacedCamera(placement), view_(view), lens_(lens) {}

Vec2 ProjectiveCamera::View::half_size(double aspect) const {
  const double t = std::tan(fov / 2);
  double half_width = t;
  switch (axis) {
    case Axis::x: break;
    case Axis::y: half_width = t * aspect; break;
    case Axis::smaller: half_width = t * std::max(aspect, 1.0); break;
    case Axis::larger: half_width = t * std::min(aspect, 1.0); break;
    case Axis::diagonal: half_width = t / std::sqrt(1 + 1 / sqr(aspect)); break;
  }
  return {half_width, half_width / aspect};
}

void ProjectiveCamera::set_raster(const Raster& raster) {
  raster_ = raster;
  const Vec2 full(raster.full_size);
  set_image_plane(view_.half_size(full.x / full.y));
}

void ProjectiveCamera::set_image_plane(const Vec2& half) {
  // (X, Y) = half * (1 - 2 (s + principal offset)), s = (raster + crop offset) / full size.
  const Vec2 full(raster_.full_size);
  to_raster_scale_ = -full / (2.0 * half);
  from_raster_scale_ = 1.0 / to_raster_scale_;
  to_raster_offset_ = full * (0.5 - view_.principal_offset) - Vec2(raster_.crop_offset);
  image_area_ = 4 * half.x * half.y * raster_.pixels() / (full.x * full.y);
}

Vec2 ProjectiveCamera::lens_offset(const SurfacePoint& xk) const {
  const Vec3 offset = xk.p - pose(xk.time).position;
  return {dot(offset, xk.shading.s), dot(offset, xk.shading.t)};
}

/// A point on the lens, with the axes of camera space at its time.
SurfacePoint ProjectiveCamera::point_at(const Vec3& p, const Frame& axes, double time) {
  SurfacePoint at;
  at.p = p;
  at.ng = axes.n;
  at.shading = axes;
  at.time = time;
  return at;
}

PositionSample ProjectiveCamera::sample_position(const Vec2& u, double time) const {
  const auto [position, axes] = pose(time);
  Vec3 p = position;
  if (!delta_position()) {
    const Vec2 offset = sample_disk(u) * lens_.radius;
    p += axes.s * offset.x + axes.t * offset.y;
  }
  const SurfacePoint at = point_at(p, axes, time);
  return {at, pdf_position(at)};
}

double ProjectiveCamera::pdf_position(const SurfacePoint&) const {
  return delta_position() ? 1 : disk_pdf() / sqr(lens_.radius);
}

Vec2 ProjectiveCamera::invert_position(const SurfacePoint& xk) const {
  return delta_position() ? Vec2(0.5) : invert_disk(lens_point(xk) / lens_.radius);
}

Vec3 ProjectiveCamera::direction(const SurfacePoint& xk, const Vec2& raster) const {
  const Vec2 plane = (raster - to_raster_offset_) / to_raster_scale_;
  const Vec2 slope = plane - lens_point(xk) / lens_.focus_distance;
  return xk.shading.to_world(normalize(Vec3(slope, 1)));
}

std::optional<Projection> ProjectiveCamera::project(const SurfacePoint& xk, const Vec3& w) const {
  const Vec3 local = xk.shading.to_local(w);
  if (!(local.z > 0)) return std::nullopt;
  const Vec2 plane = Vec2(local) / local.z + lens_point(xk) / lens_.focus_distance;
  const Vec2 raster = plane * to_raster_scale_ + to_raster_offset_;
  if (!raster_.contains(raster)) return std::nullopt;
  const double image_density = 1 / (image_area_ * sqr(sqr(local.z)));  // 1 / (A c^4)
  // pdf_position = 1 / A_lens
  return Projection{raster, image_density * pdf_position(xk),
                    image_density * (raster_.pixels() / raster_.sampled_area())};
}

std::optional<SurfacePoint> ProjectiveCamera::move_on_lens(const SurfacePoint& xk,
                                                           const Vec2& by) const {
  const Vec3 p = xk.p + xk.shading.s * by.x + xk.shading.t * by.y;
  if (!(length_squared(p - pose(xk.time).position) < sqr(lens_.radius))) return std::nullopt;
  SurfacePoint moved = point_at(p, xk.shading, xk.time);
  moved.wavelength = xk.wavelength;
  return moved;
}

std::optional<SurfacePoint> ProjectiveCamera::hit_lens(const Ray& ray) const {
  const auto [position, axes] = pose(ray.time);
  const double t = dot(position - ray.o, axes.n) / dot(ray.d, axes.n);
  if (!(t > 0 && t < ray.t_max)) return std::nullopt;
  const Vec3 p = ray.o + ray.d * t;
  if (!(length_squared(p - position) < sqr(lens_.radius))) return std::nullopt;
  return point_at(p, axes, ray.time);
}

}  // namespace mlt
