#include "scene/camera/panoramic.h"

namespace mlt {

PositionSample PanoramicCamera::sample_position(const Vec2&, double time) const {
  const auto [position, axes] = pose(time);
  SurfacePoint at;
  at.p = position;
  at.ng = axes.n;
  at.shading = axes;
  at.kind = PointKind::isolated;
  at.medium = surroundings();
  at.time = time;
  return {at, 1};
}

std::optional<Projection> PanoramicCamera::project(const SurfacePoint& xk, const Vec3& w) const {
  const auto seen = find(xk.shading.to_local(w));
  if (!seen) return std::nullopt;
  const Vec2 raster = seen->position - Vec2(raster_.crop_offset);
  if (!raster_.contains(raster)) return std::nullopt;
  return Projection{raster, seen->pixels_per_steradian / raster_.pixels(),
                    seen->pixels_per_steradian / raster_.sampled_area()};
}

}  // namespace mlt
