#include "path/path.h"

namespace mlt {

std::optional<Vec2> raster_position(const Scene& scene, const Path& path) {
  const int k = path.edges();
  return scene.camera().raster_position(path[k].at, direction(path[k].at, path[k - 1].at));
}

bool is_specular(const Scene& scene, const Vertex& x, const SurfacePoint& towards_light,
                 const SurfacePoint& towards_camera, double near_specular) {
  if (x.delta()) return true;
  if (x.kind != VertexKind::surface || near_specular <= 0) return false;
  const Vec3 wl = x.at.shading.to_local(direction(x.at, towards_light));
  const Vec3 wc = x.at.shading.to_local(direction(x.at, towards_camera));
  return scene.bsdf(x.at).roughness(x.at, wl, wc) < near_specular;
}

std::string signature(const Scene& scene, const Path& path, double near_specular) {
  std::string letters = "L";
  for (int i = 1; i < path.edges(); ++i)
    letters += is_specular(scene, path[i], path[i - 1].at, path[i + 1].at, near_specular) ? 'S' : 'D';
  return letters + 'E';
}

}  // namespace mlt
