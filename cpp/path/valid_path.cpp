#include "path/valid_path.h"

#include "scene/mesh/mesh.h"

namespace mlt {
namespace {

/// Whether the light, surface or medium of the vertex exists in the scene.
bool in_scene(const Scene& scene, const Vertex& x) {
  if (x.at.medium != no_medium && x.at.medium >= scene.media().size()) return false;
  if (x.at.in_medium()) {
    if (x.delta() || x.at.medium == no_medium || x.kind == VertexKind::camera) return false;
    const Emitter* light = scene.emitter(x.at);
    return x.kind == VertexKind::inner || (light && light->index() == x.emitter);
  }
  const bool on_shape = x.at.shape != SurfacePoint::no_shape;
  if (on_shape) {
    if (x.at.shape >= scene.shapes().size()) return false;
    const Mesh* mesh = scene.shapes()[x.at.shape]->as_mesh();
    if (mesh && x.at.primitive >= mesh->data().triangles.size()) return false;
  }
  if (x.kind != VertexKind::light) return on_shape == (x.kind == VertexKind::inner);
  if (x.emitter >= scene.emitters().size()) return false;
  const Emitter* emitter = scene.emitters()[x.emitter].get();
  if (x.delta() != emitter->delta_direction()) return false;
  return on_shape ? scene.emitter(x.at) == emitter : emitter->infinite() || emitter->delta();
}

bool has_valid_wavelength(const Scene& scene, const Path& path) {
  if (!scene.camera().spectral()) return path.wavelength == rgb_lanes;
  const double u = scene.camera().invert_wavelength(path.wavelength);
  return u >= 0 && (scene.camera().band() ? u <= 1 : u < 1);
}

}  // namespace

bool is_valid_path(const Scene& scene, const Path& path) {
  const size_t count = path.vertices.size();
  for (size_t i = 0; i < count; ++i) {
    const Vertex& x = path[i];
    const VertexKind expected = i == 0           ? VertexKind::light
                                : i == count - 1 ? VertexKind::camera
                                                 : VertexKind::inner;
    if (x.kind != expected || x.lobe > Lobe::transmission || x.at.kind > PointKind::infinite ||
        !in_scene(scene, x))
      return false;
  }
  return count >= 2 && has_valid_wavelength(scene, path);
}

}  // namespace mlt
