// The shapes, lights and sensors of a scene, as they are listed in Python.
#include "scene_parts.h"

#include "scene_editing.h"
#include "shape_triangles.h"
#include "text.h"

#include "io/editing.h"
#include "io/surface_names.h"
#include "job/plugins.h"

#include <fmt/format.h>

#include <map>

namespace mlt::python {
namespace {

struct ScenePart {
  LoadedPtr scene;
  std::string name, type;
  int64_t index;
};

struct ShapePart : ScenePart {
  std::string material;
  Vec3 low, high;
  bool emits;
};

Doubles to_array(const Vec3& v) { return Doubles(3, &v.x); }

py::tuple box(const Vec3& low, const Vec3& high) {
  return py::make_tuple(to_array(low), to_array(high));
}

/// The plug-ins of one family, in the order of the scene.
py::list parts_of(const LoadedPtr& loaded, const std::string& family) {
  Node tree = loaded->tree;
  py::list parts;
  for (const NamedNode& named : name_nodes(tree, plugins()))
    if (named.node->family == family)
      parts.append(ScenePart{loaded, named.name, named.node->type, int64_t(parts.size())});
  return parts;
}

py::list shapes_of(const LoadedPtr& loaded) {
  Node tree = loaded->tree;
  std::map<std::string, std::string> types;
  for (const NamedNode& named : name_nodes(tree, plugins())) types[named.name] = named.node->type;
  const Scene& scene = *loaded->scene;
  const SurfaceNames names = surface_names(*loaded, plugins());
  py::list parts;
  for (size_t i = 0; i < names.objects.size() && !names.objects[i].empty(); ++i) {
    const Shape& shape = *scene.shapes()[i];
    Vec3 low, high;
    shape.bounds(low, high);
    parts.append(ShapePart{{loaded, names.objects[i], types.at(names.objects[i]), int64_t(i)},
                           names.materials[i],
                           low + scene.origin(),
                           high + scene.origin(),
                           shape.emitter() != nullptr});
  }
  return parts;
}

py::tuple box_of(const LoadedScene& loaded) {
  Vec3 low(infinity), high(-infinity);
  const std::unordered_set<const Shape*> in_groups = shapes_in_groups(*loaded.scene);
  for (const ShapePtr& shape : loaded.scene->shapes()) {
    if (in_groups.count(shape.get()) > 0) continue;
    Vec3 l, h;
    shape->bounds(l, h);
    low = glm::min(low, l);
    high = glm::max(high, h);
  }
  return box(low + loaded.scene->origin(), high + loaded.scene->origin());
}

}  // namespace

void bind_scene_parts(py::class_<LoadedScene, LoadedPtr>& scene) {
  py::class_<ScenePart>(scene, "Part", "A plug-in of a scene.")
      .def_property_readonly(
          "name", [](const ScenePart& part) { return to_str(part.name); },
          "What its parameters begin with: its id, or one that was given to it.")
      .def_property_readonly(
          "type", [](const ScenePart& part) { return to_str(part.type); },
          "The name of its plug-in, such as \"sphere\".")
      .def_readonly("index", &ScenePart::index,
                    "Its place in the list; of a sensor, what `sensor=` means by it.")
      .def_property_readonly(
          "parameters", [](const ScenePart& part) { return parameters_of(*part.scene, part.name); },
          "What can be changed, without its own name, with the values of now.")
      .def("__index__", [](const ScenePart& part) { return part.index; })
      .def("__repr__", [](const ScenePart& part) {
        return to_str(fmt::format("<{} '{}'>", part.type, part.name));
      });
  py::class_<ShapePart, ScenePart>(scene, "ShapePart", "A shape or an instance of a scene.")
      .def_property_readonly(
          "material", [](const ShapePart& part) { return to_str(part.material); },
          "The name of its BSDF; empty for instances.")
      .def_property_readonly(
          "bbox", [](const ShapePart& part) { return box(part.low, part.high); },
          "The lowest and the highest coordinates, two arrays (3,), at all times.")
      .def_readonly("emits", &ShapePart::emits, "Whether it is a lamp.");
  scene
      .def("shapes", &shapes_of,
           "Its shapes and instances, without parts of groups, in the order that `triangles` and\n"
           "LightPath.vertices have.")
      .def(
          "emitters", [](const LoadedPtr& loaded) { return parts_of(loaded, "emitter"); },
          "Its lights, those of shapes among them.")
      .def(
          "sensors", [](const LoadedPtr& loaded) { return parts_of(loaded, "sensor"); },
          "Its sensors, any of which may be given to `render` as `sensor`.")
      .def("bbox", &box_of,
           "The lowest and the highest coordinates of all shapes, two arrays (3,), at all times.")
      .def(
          "with_sensor",
          [](const LoadedScene& s, int64_t sensor) { return with_sensor(s, sensor, plugins()); },
          py::arg("sensor"), NoGil(), "The same scene, seen by another of its sensors.")
      .def("with_sensor", &seen_by, py::arg("sensor"),
           "The same scene, seen by a sensor that is not in it, a dict with its film inside.\n\n"
           "Raises SceneError for one that is wrong.");
}

}  // namespace mlt::python
