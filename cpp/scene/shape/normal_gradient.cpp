#include "scene/shape/normal_gradient.h"

#include "scene/accel/instance.h"
#include "scene/mesh/mesh.h"
#include "scene/shape/cylinder.h"
#include "scene/shape/sphere.h"

namespace mlt {
namespace {

/// A multiple of the shading normal, and its derivative by the position.
struct Normal {
  Vec3 v;
  Mat3 derivative;
};

/// The normal interpolated from those of the corners, moved by the transpose of `inverse` (see
/// Mesh::moved_normal); its derivative is by positions on the mesh itself.
Normal normal_of(const Mesh& mesh, const SurfacePoint& at, const Mat3& inverse) {
  const MeshData& data = mesh.data();
  const Normal flat{at.ng, Mat3(0)};
  if (data.normals.empty()) return flat;
  const auto& corners = data.triangles[at.primitive];
  const auto moved = [&](int i) { return normalize(Vec3(data.normals[corners[i]]) * inverse); };
  const Vec3 n0 = moved(0), d1 = moved(1) - n0, d2 = moved(2) - n0;
  const Vec2 b = mesh.barycentrics(at);
  const Vec3 sum = n0 + d1 * b.x + d2 * b.y;
  if (!(length_squared(sum) > 1e-12)) return flat;
  const MeshData::Triangle tri = data.triangle(corners);
  const double scale = 1 / length_squared(tri.normal);
  return {sum, glm::outerProduct(d1, cross(tri.e2, tri.normal) * scale) +
                   glm::outerProduct(d2, cross(tri.normal, tri.e1) * scale)};
}

Normal normal_of(const Shape& shape, const SurfacePoint& at) {
  if (const Mesh* mesh = shape.as_mesh()) return normal_of(*mesh, at, Mat3(1));
  if (const auto* sphere = dynamic_cast<const Sphere*>(&shape))
    return {at.p - sphere->center(), Mat3(1)};
  if (const auto* cylinder = dynamic_cast<const Cylinder*>(&shape)) {
    const Mat3 across = Mat3(1) - glm::outerProduct(cylinder->axis(), cylinder->axis());
    return {across * (at.p - cylinder->base()), across};
  }
  return {at.ng, Mat3(0)};
}

Normal normal_of(const Instance& instance, const Shape& shape, const SurfacePoint& at) {
  const Mat3 inverse = instance.map_at(at.time).inverse;
  const SurfacePoint inner = instance.in_group(at);
  if (const Mesh* mesh = shape.as_mesh()) {
    const Normal n = normal_of(*mesh, inner, inverse);
    return {n.v, n.derivative * inverse};
  }
  const Normal n = normal_of(shape, inner);
  return {n.v * inverse, glm::transpose(inverse) * n.derivative * inverse};
}

}  // namespace

Mat3 normal_gradient(const Scene& scene, const SurfacePoint& at) {
  const Shape& shape = *scene.shapes()[at.shape];
  const Normal n = at.instance == SurfacePoint::no_shape
                       ? normal_of(shape, at)
                       : normal_of(*scene.shapes()[at.instance]->as_instance(), shape, at);
  // the derivative of v / |v|, on the side of the shading normal
  const double l = length(n.v) * std::copysign(1.0, dot(n.v, at.shading.n));
  return (n.derivative - glm::outerProduct(n.v, n.v * n.derivative) * (1 / sqr(l))) * (1 / l);
}

}  // namespace mlt
