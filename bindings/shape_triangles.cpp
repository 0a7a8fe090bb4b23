// The shapes of a scene as triangles for a viewer: meshes unchanged, analytic shapes as a grid.
#include "shape_triangles.h"

#include "scene/accel/instance.h"
#include "scene/mesh/mesh.h"

namespace mlt::python {
namespace {

struct Triangles {
  std::vector<Vec3f> corners;
  std::vector<std::array<uint32_t, 3>> faces;
};

/// Appends a mesh, whose buffers are in the space of the world or of a group.
template <class Place>
void append(const MeshData& mesh, const Place& place, Triangles& to) {
  const auto first = static_cast<uint32_t>(to.corners.size());
  for (const Vec3f& p : mesh.positions) to.corners.emplace_back(place(Vec3(p)));
  for (const auto& [a, b, c] : mesh.triangles)
    to.faces.push_back({first + a, first + b, first + c});
}

/// The unit square that sample_position maps to the surface, as a grid.
template <class Place>
void append_grid(const Shape& shape, const Place& place, Triangles& to) {
  constexpr uint32_t n = 32;
  const auto first = static_cast<uint32_t>(to.corners.size());
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x)
      to.corners.emplace_back(place(shape.sample_position(Vec2(x, y) / double{n}).at.p));
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t a = first + y * (n + 1) + x, b = a + n + 1;
      to.faces.push_back({a, a + 1, b + 1});
      to.faces.push_back({a, b + 1, b});
    }
}

template <class Place>
void append(const Shape& shape, const Place& place, Triangles& to) {
  if (const Mesh* mesh = shape.as_mesh())
    append(mesh->data(), place, to);
  else if (shape.as_analytic())
    append_grid(shape, place, to);
}

Triangles triangles_of(const Shape& shape) {
  Triangles found;
  if (const Instance* instance = shape.as_instance()) {
    const AffineMap map = instance->map_at(0);
    for (const ShapePtr& part : instance->group().shapes())
      append(*part, [&](const Vec3& p) { return map.point(p); }, found);
  } else {
    append(shape, [](const Vec3& p) { return p; }, found);
  }
  return found;
}

/// The first shape of an instance's group, for its material, or the shape itself.
const Shape& shown_part(const Shape& shape) {
  const Instance* instance = shape.as_instance();
  return instance ? *instance->group().shapes().front() : shape;
}

py::dict described(const Shape& shape, uint32_t index, const Vec3f& origin) {
  Triangles found = without_gil([&] { return triangles_of(shape); });
  for (Vec3f& p : found.corners) p += origin;
  const Shape& part = shown_part(shape);
  PositionSample sample;
  if (const Mesh* mesh = part.as_mesh())
    mesh->textured_point(0, Vec2(1 / 3.0), sample.at);
  else
    sample = part.sample_position({0.5, 0.5});
  const Color albedo = part.bsdf().albedo(sample.at).rgb();
  py::dict shown;
  shown["shape"] = index;
  shown["positions"] = py::array_t<float>({found.corners.size(), size_t{3}},
                                          reinterpret_cast<const float*>(found.corners.data()));
  shown["faces"] = py::array_t<uint32_t>({found.faces.size(), size_t{3}},
                                         reinterpret_cast<const uint32_t*>(found.faces.data()));
  shown["albedo"] = py::make_tuple(albedo.x, albedo.y, albedo.z);
  shown["emits"] = part.emitter() != nullptr;
  return shown;
}

}  // namespace

std::unordered_set<const Shape*> shapes_in_groups(const Scene& scene) {
  std::unordered_set<const Shape*> in_groups;
  for (const ShapePtr& shape : scene.shapes())
    if (const Instance* instance = shape->as_instance())
      for (const ShapePtr& part : instance->group().shapes()) in_groups.insert(part.get());
  return in_groups;
}

py::list shape_triangles(const LoadedScene& loaded) {
  const std::vector<ShapePtr>& shapes = loaded.scene->shapes();
  const std::unordered_set<const Shape*> in_groups = shapes_in_groups(*loaded.scene);
  py::list shown;
  for (uint32_t i = 0; i < shapes.size(); ++i)
    if (!in_groups.count(shapes[i].get()))
      shown.append(described(*shapes[i], i, loaded.scene->origin()));
  return shown;
}

}  // namespace mlt::python
